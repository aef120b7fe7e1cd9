// Terminal: results go to standard output, messages to standard error. A result that cannot be written is an error.
#pragma once

#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <thread>

namespace isoatlas::cli {

class Terminal {
public:
    struct Style {
        bool quiet = false, no_color = false, hints = true;
        int verbose = 0;
    };
    Terminal();
    ~Terminal();
    Terminal(const Terminal&) = delete;
    Terminal& operator=(const Terminal&) = delete;

    void set_style(const Style& style) { style_ = style; }
    [[nodiscard]] const Style& style() const { return style_; }

    /// Standard output. Throws Error{resource} when writing fails (disk full, pipe closed).
    [[nodiscard]] std::ostream& out();
    /// Flushes and checks standard output: call before reporting success.
    void finish();
    /// Of a verb that failed: what it printed and what is not written yet.
    void forget();
    /// The bytes of a file, to standard output.
    void send_file(const std::string& path);
    /// What `print` writes to out(), instead of standard output.
    [[nodiscard]] std::string collected(const std::function<void()>& print);

    /// One line on standard error unless --quiet, behind what was printed before it; so all that follow.
    void say(const std::string& line);
    /// One line on standard error, also with --quiet.
    void warn(const std::string& line);
    /// How the program was started: the first word of the commands of next(), where the shell does not find `isoatlas`.
    void set_program(const std::string& path);
    /// "next: COMMAND" on standard error unless --quiet.
    void next(const std::string& command);
    /// One line on standard error with -v.
    void detail(const std::string& line);

    [[nodiscard]] bool is_interactive() const;                      ///< standard error is a terminal that can rewrite a line
    [[nodiscard]] std::string bold(const std::string& text) const;  ///< of results; no colours unless standard output shows them

private:
    void talk(const std::string& line);
    class Buffer;
    std::unique_ptr<Buffer> buffer_;
    std::ostream out_;
    Style style_;
    std::string program_ = "isoatlas";
    std::thread::id owner_ = std::this_thread::get_id();  ///< which prints; others may talk
};

}  // namespace isoatlas::cli
