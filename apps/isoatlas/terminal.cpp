#include "terminal.h"

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <streambuf>

#include <unistd.h>

#include <isoatlas/error.h>

namespace isoatlas::cli {
namespace {

[[noreturn]] void output_failed(int error) {
    throw Error(ErrorKind::resource, {.file = "standard output",
                                      .what = std::string("cannot be written: ") + std::strerror(error),
                                      .next = error == EPIPE ? "keep the reader of the pipe open" : "send it to a place with free space"});
}

void talk(const std::string& line) {
    const std::string text = line + "\n";
    // Talk that nobody can read is no reason to fail.
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
}

bool colours_wanted(int file) {
    const char* no_color = std::getenv("NO_COLOR");
    const char* term = std::getenv("TERM");
    if (no_color != nullptr && *no_color != '\0') return false;
    return ::isatty(file) != 0 && term != nullptr && std::strcmp(term, "dumb") != 0;
}

}  // namespace

class Terminal::Buffer : public std::streambuf {
public:
    Buffer() { setp(bytes_.data(), bytes_.data() + bytes_.size()); }

    void flush() {
        const char* next = pbase();
        while (next < pptr()) {
            const ssize_t written = ::write(STDOUT_FILENO, next, static_cast<std::size_t>(pptr() - next));
            if (written < 0 && errno == EINTR) continue;
            if (written < 0) {
                const int error = errno;
                setp(bytes_.data(), bytes_.data() + bytes_.size());
                output_failed(error);
            }
            next += written;
        }
        setp(bytes_.data(), bytes_.data() + bytes_.size());
    }

protected:
    int_type overflow(int_type c) override {
        flush();
        if (!traits_type::eq_int_type(c, traits_type::eof())) sputc(traits_type::to_char_type(c));
        return traits_type::not_eof(c);
    }
    int sync() override {
        flush();
        return 0;
    }

private:
    std::array<char, 1 << 16> bytes_;
};

Terminal::Terminal() : buffer_(std::make_unique<Buffer>()), out_(buffer_.get()) {
    out_.exceptions(std::ios::badbit);  // so that the Error of Buffer::flush comes through
}

Terminal::~Terminal() = default;

std::ostream& Terminal::out() { return out_; }

void Terminal::finish() { out_.flush(); }

void Terminal::say(const std::string& line) {
    if (!style_.quiet) talk(line);
}

void Terminal::warn(const std::string& line) { talk("warning: " + line); }

void Terminal::next(const std::string& command) { say("next: " + command); }

void Terminal::detail(const std::string& line) {
    if (style_.verbose > 0) talk(line);
}

bool Terminal::is_interactive() const {
    const char* term = std::getenv("TERM");
    return !style_.quiet && ::isatty(STDERR_FILENO) != 0 && term != nullptr && std::strcmp(term, "dumb") != 0;
}

std::string Terminal::bold(const std::string& text) const {
    return style_.no_color || !colours_wanted(STDOUT_FILENO) ? text : "\033[1m" + text + "\033[0m";
}

}  // namespace isoatlas::cli
