#include "text/terminal.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <streambuf>
#include <string_view>
#include <thread>

#include <unistd.h>

#include <isoatlas/error.h>
#include <isoatlas/shell_word.h>
#include <isoatlas/text.h>

namespace isoatlas::cli {
namespace {

[[noreturn]] void output_failed(int error) {
    throw Error(ErrorKind::resource, {.file = "standard output",
                                      .what = std::string("cannot be written: ") + std::strerror(error),
                                      .next = error == EPIPE ? "keep the reader of the pipe open" : "send it to a place with free space"});
}

/// Is there a program of this name on the path of the shell? There, nothing between two colons is the current folder.
bool is_on_path(const std::string& name) {
    const char* path = std::getenv("PATH");
    std::istringstream folders(path == nullptr ? "" : path);
    for (std::string folder; std::getline(folders, folder, ':');) {
        const std::string file = (folder.empty() ? "." : folder) + "/" + name;
        std::error_code none;
        if (std::filesystem::is_regular_file(file, none) && ::access(file.c_str(), X_OK) == 0) return true;
    }
    return false;
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

    /// Where text goes: nullptr: standard output.
    void send_to(std::string* text) { text_ = text; }
    [[nodiscard]] bool is_collecting() const { return text_ != nullptr; }
    void drop() { empty(); }

    /// Results are valid UTF-8, whatever file names they contain. An incomplete character waits for its remaining bytes, unless this is the
    /// end.
    void flush(bool is_end) {
        const std::string_view all(pbase(), static_cast<std::size_t>(pptr() - pbase()));
        const std::string_view text = is_end ? all : whole_characters(all);
        const std::string kept(all.substr(text.size()));
        if (is_utf8(text)) {
            write(text);
        } else {
            write(written_name(text));
        }
        empty();
        sputn(kept.data(), static_cast<std::streamsize>(kept.size()));
    }

protected:
    int_type overflow(int_type c) override {
        flush(false);
        if (!traits_type::eq_int_type(c, traits_type::eof())) sputc(traits_type::to_char_type(c));
        return traits_type::not_eof(c);
    }
    int sync() override {
        flush(true);
        return 0;
    }

private:
    static std::string_view whole_characters(std::string_view text) {
        for (std::size_t kept = 1; kept <= std::min<std::size_t>(3, text.size()); ++kept) {
            const auto byte = static_cast<unsigned char>(text[text.size() - kept]);
            if (byte < 0x80) break;
            if (byte >= 0xc0) return text.substr(0, text.size() - kept);
        }
        return text;
    }
    void empty() { setp(bytes_.data(), bytes_.data() + bytes_.size()); }
    void write(std::string_view text) {
        if (text_ != nullptr) {
            text_->append(text);
        } else {
            write_bytes(text);
        }
    }

public:
    /// To standard output, as they are.
    void write_bytes(std::string_view text) {
        while (!text.empty()) {
            const ssize_t written = ::write(STDOUT_FILENO, text.data(), text.size());
            if (written < 0 && errno == EINTR) continue;
            if (written < 0) {
                const int error = errno;
                empty();
                output_failed(error);
            }
            text.remove_prefix(static_cast<std::size_t>(written));
        }
    }

private:
    std::array<char, 1 << 16> bytes_;
    std::string* text_ = nullptr;
};

Terminal::Terminal() : buffer_(std::make_unique<Buffer>()), out_(buffer_.get()) {
    out_.exceptions(std::ios::badbit);  // so that the Error of Buffer::flush is rethrown
}

Terminal::~Terminal() = default;

std::ostream& Terminal::out() { return out_; }

void Terminal::finish() { out_.flush(); }

std::string Terminal::collected(const std::function<void()>& print) {
    finish();
    std::string text;
    buffer_->send_to(&text);
    try {
        print();
        finish();
    } catch (...) {
        buffer_->drop();
        buffer_->send_to(nullptr);
        throw;
    }
    buffer_->send_to(nullptr);
    return text;
}

void Terminal::forget() { buffer_->drop(); }

void Terminal::send_file(const std::string& path) {
    finish();
    std::ifstream file(path, std::ios::binary);
    std::array<char, 1 << 16> block;
    while (file.read(block.data(), block.size()), file.gcount() > 0)
        buffer_->write_bytes({block.data(), static_cast<std::size_t>(file.gcount())});
}

void Terminal::set_program(const std::string& path) {
    if (path.find('/') != std::string::npos && !is_on_path("isoatlas")) program_ = shell_word(path);
}

/// File names may hold any byte: invalid UTF-8 and control characters are escaped, line ends are kept.
void Terminal::talk(const std::string& line) {
    if (out_.good() && !buffer_->is_collecting() && std::this_thread::get_id() == owner_) out_.flush();
    const std::string text = header_text(written_name(line), /*lines=*/true) + "\n";
    // A failed write of a message is not an error.
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
}

void Terminal::say(const std::string& line) {
    if (!style_.quiet) talk(line);
}

void Terminal::warn(const std::string& line) { talk("warning: " + line); }

void Terminal::next(const std::string& command) {
    constexpr std::string_view name = "isoatlas";
    if (!style_.hints) return;
    say("next: " + (command.starts_with("isoatlas ") ? program_ + command.substr(name.size()) : command));
}

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
