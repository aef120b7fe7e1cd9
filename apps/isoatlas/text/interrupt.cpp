#include "text/interrupt.h"

#include <atomic>
#include <csignal>
#include <cstring>

#include <unistd.h>

#include <isoatlas/error.h>
#include <isoatlas/output_file.h>

namespace isoatlas::cli {
namespace {

constexpr int kExitCode = static_cast<int>(ErrorKind::cancelled);

std::atomic<int> signals{0};
std::atomic<bool> writing{false};
constexpr const char* kStopped = "stopped";
std::atomic<const char*> last_words{kStopped};
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

void on_signal(int) {
    const bool again = signals.fetch_add(1) > 0;
    if (!writing && !again) return;
    remove_unfinished_files();
    for (const char* text : {"\n", last_words.load(), "\n"}) [[maybe_unused]]
        const ssize_t said = ::write(STDERR_FILENO, text, std::strlen(text));
    ::_exit(kExitCode);
}

}  // namespace

void catch_signals() {
    struct sigaction action{};
    action.sa_handler = on_signal;
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    action.sa_handler = SIG_IGN;
    sigaction(SIGPIPE, &action, nullptr);
    sigaction(SIGXFSZ, &action, nullptr);  // a limit on file sizes is reported as an error of the write
}

bool interrupted() { return signals > 0; }

void stop_if_interrupted() {
    if (interrupted()) throw Error(ErrorKind::cancelled, {.what = "stopped by the user; nothing was written"});
}

WritingGuard::WritingGuard(const char* message) {
    stop_if_interrupted();
    last_words = message;
    writing = true;
}

WritingGuard::~WritingGuard() {
    writing = false;
    last_words = kStopped;
}

}  // namespace isoatlas::cli
