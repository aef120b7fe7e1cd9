// Ctrl-C: cancels the running call; while a file is being written, removes the unfinished file and exits at once.
#pragma once

namespace isoatlas::cli {

/// SIGINT and SIGTERM interrupt; SIGPIPE becomes an ordinary write error.
void catch_signals();

[[nodiscard]] bool interrupted();

/// Throws Error{cancelled} when interrupted.
void stop_if_interrupted();

/// During its lifetime an interrupt removes the unfinished output and exits. message: printed then; it must have static lifetime.
class WritingGuard {
public:
    explicit WritingGuard(const char* message = "stopped: the unfinished output was removed");
    ~WritingGuard();
    WritingGuard(const WritingGuard&) = delete;
    WritingGuard& operator=(const WritingGuard&) = delete;
};

}  // namespace isoatlas::cli
