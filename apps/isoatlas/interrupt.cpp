#include "interrupt.h"

#include <array>
#include <atomic>
#include <csignal>
#include <cstring>
#include <filesystem>

#include <unistd.h>

#include <isoatlas/error.h>

namespace isoatlas::cli {
namespace {

constexpr int kExitCode = static_cast<int>(ErrorKind::cancelled);

std::atomic<int> signals{0};
std::atomic<bool> writing{false};
constexpr const char* kStopped = "stopped";
std::atomic<const char*> last_words{kStopped};
std::array<char, 4096> partial{};  // a fixed buffer: the handler may not allocate
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

void on_signal(int) {
    const bool again = signals.fetch_add(1) > 0;
    if (!writing && !again) return;
    if (writing && partial[0] != '\0') ::unlink(partial.data());
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
    sigaction(SIGXFSZ, &action, nullptr);  // a limit on file sizes is an error of the write, which is told
}

bool interrupted() { return signals > 0; }

void stop_if_interrupted() {
    if (interrupted()) throw Error(ErrorKind::cancelled, {.what = "stopped by the user; nothing was written"});
}

WritingGuard::WritingGuard(const std::string& path, const char* message) {
    stop_if_interrupted();
    std::error_code ignored;
    const std::filesystem::path target = std::filesystem::weakly_canonical(path, ignored);  // writers follow links
    const std::string name = (target.empty() ? path : target.string()) + ".partial";
    partial[0] = '\0';
    if (name.size() < partial.size()) std::memcpy(partial.data(), name.c_str(), name.size() + 1);
    last_words = message;
    writing = true;
}

WritingGuard::~WritingGuard() {
    writing = false;
    last_words = kStopped;
}

}  // namespace isoatlas::cli
