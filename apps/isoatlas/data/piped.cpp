#include "data/piped.h"

#include <array>
#include <cerrno>
#include <fstream>
#include <map>
#include <vector>

#include <unistd.h>

#include "text/interrupt.h"
#include "text/terminal.h"

namespace isoatlas::cli {
namespace {

constexpr std::size_t kBlock = std::size_t{1} << 20;

[[noreturn]] void refuse(const std::string& what, const std::string& next) { throw Error(ErrorKind::usage, {.what = what, .next = next}); }

/// Of `-o -` alone; `-o -.stl` says another one.
std::string extension_of(const Arguments& arguments) {
    static const std::map<std::string, const char*> kDefault{
        {"atlas", ".html"}, {"measure", ".csv"},  {"extract", ".ply"}, {"render", ".png"},   {"animate", ".gif"},  {"tree", ".json"},
        {"label", ".nrrd"}, {"spectrum", ".csv"}, {"build", ".atlas"}, {"convert", ".nrrd"}, {"phantom", ".nrrd"}, {"compare", ".html"}};
    if (arguments.output != "-") return arguments.output.substr(1);
    const auto found = kDefault.find(arguments.verb);
    if (found == kDefault.end()) refuse("`isoatlas " + arguments.verb + "` cannot write to standard output", "give -o the name of a file");
    return found->second;
}

bool goes_to_output(const std::string& output) { return output == "-" || output.starts_with("-."); }

}  // namespace

Piped::Piped(Arguments& arguments, Terminal& terminal) : terminal_(terminal) {
    if (goes_to_output(arguments.output)) take_output(arguments);
    if (arguments.file == "-") read_input(arguments);
    if (!folder_) return;
    Terminal::Style style = terminal_.style();
    style.hints = false;  // their files will be gone
    terminal_.set_style(style);
}

const std::string& Piped::folder() {
    if (!folder_) folder_.emplace();
    return folder_->path();
}

void Piped::take_output(Arguments& arguments) {
    if (arguments.verb == "ask") {  // which prints the answer anyway
        arguments.output.clear();
        return;
    }
    if (arguments.json) refuse("--json and -o - both need standard output", "give -o the name of a file, or omit --json");
    if (arguments.split || (arguments.verb == "build" && arguments.all) || arguments.polarity == PolarityChoice::both)
        refuse("standard output takes one file", "give -o the name of a file: several are written");
    const std::string extension = extension_of(arguments);
    arguments.output = output_ = folder() + "/standard-output" + extension;
}

void Piped::read_input(Arguments& arguments) {
    if (arguments.verb == "view" || arguments.verb == "name")
        refuse("`isoatlas " + arguments.verb + "` keeps files beside the volume", "save the volume as a file and give its name");
    if (arguments.output.empty() && (arguments.verb == "atlas" || arguments.verb == "build"))
        refuse("a volume from standard input has no name to call the result after", "add -o and a name");
    if (::isatty(STDIN_FILENO) != 0) refuse("standard input is a terminal", "send a volume: isoatlas " + arguments.verb + " - < scan.nrrd");
    arguments.file = input_ = folder() + "/standard-input";
    std::ofstream file(arguments.file, std::ios::binary);
    std::vector<char> block(kBlock);
    for (;;) {
        stop_if_interrupted();
        const ssize_t got = ::read(STDIN_FILENO, block.data(), block.size());
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) temporary_file_failed("standard input", errno);
        if (got == 0) break;
        if (!file.write(block.data(), got)) temporary_file_failed("standard input", errno);
    }
    file.close();
    if (!file) temporary_file_failed("standard input", errno);
}

Error Piped::renamed(const Error& error) const {
    ErrorText text = error.text();
    for (std::string* part : {&text.file, &text.what, &text.next}) {
        for (const auto& [path, name] : {std::pair(output_, "standard output"), std::pair(input_, "standard input")}) {
            const std::size_t at = path.empty() ? std::string::npos : part->find(path);
            if (at != std::string::npos) part->replace(at, path.size(), name);
        }
    }
    return {error.kind(), text};
}

int Piped::run(const std::function<int()>& verb) {
    if (!folder_) return verb();
    int code = 0;
    const auto named = [&] {
        try {
            code = verb();
        } catch (const Error& error) {
            throw renamed(error);
        }
    };
    if (output_.empty()) {
        named();
        return code;
    }
    std::string text = terminal_.collected(named);
    while (!text.empty() && text.back() == '\n') text.pop_back();
    if (const std::size_t at = text.find(output_); at != std::string::npos) text.replace(at, output_.size(), "standard output");
    if (!text.empty()) terminal_.say(text);
    terminal_.send_file(output_);
    return code;
}

}  // namespace isoatlas::cli
