// Ctrl-C: the first one asks the running call to stop; while a file is being written it removes the unfinished file and leaves at once.
#pragma once

namespace isoatlas::cli {

/// SIGINT and SIGTERM interrupt; SIGPIPE becomes an ordinary write error.
void catch_signals();

[[nodiscard]] bool interrupted();

/// Throws Error{cancelled} when interrupted.
void stop_if_interrupted();

/// While it lives, an interrupt removes what is being written and leaves. message: said then; it must live as long as the program.
class WritingGuard {
public:
    explicit WritingGuard(const char* message = "stopped: the unfinished output was removed");
    ~WritingGuard();
    WritingGuard(const WritingGuard&) = delete;
    WritingGuard& operator=(const WritingGuard&) = delete;
};

}  // namespace isoatlas::cli
