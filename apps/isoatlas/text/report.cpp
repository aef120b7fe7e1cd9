#include "text/report.h"

#include <exception>

#include "text/advice.h"
#include "text/choices.h"
#include "text/document.h"
#include "text/terminal.h"

namespace isoatlas::cli {
namespace {

const char* kind_name(ErrorKind kind) {
    switch (kind) {
        case ErrorKind::internal: return "internal";
        case ErrorKind::usage: return "usage";
        case ErrorKind::input: return "input";
        case ErrorKind::unsupported: return "unsupported";
        case ErrorKind::resource: return "resource";
        case ErrorKind::not_found: return "not_found";
        case ErrorKind::verification: return "verification";
        case ErrorKind::cancelled: return "cancelled";
    }
    return "internal";
}

}  // namespace

int report(const Error& failed, const std::vector<std::string>& words, bool json, Terminal& terminal) {
    const Error error = with_options(failed);
    const int code = static_cast<int>(error.kind());
    Terminal::Style style = terminal.style();
    style.quiet = false;
    terminal.set_style(style);
    const std::vector<ChoiceCommand> choices = commands_of(error, words);
    terminal.say(std::string("isoatlas: ") + error.what() + (choices.empty() ? "" : "\n" + lines_of(choices)));
    if (!json) return code;
    const ErrorText& text = error.text();
    Json document_of_error = document("error");
    document_of_error["error"] = {{"kind", kind_name(error.kind())},
                                  {"exit_code", code},
                                  {"message", error.what()},
                                  {"file", text.file},
                                  {"where", text.where},
                                  {"what", text.what},
                                  {"expected", text.expected},
                                  {"next", text.next},
                                  {"reason", name_of(text.reason)},
                                  {"value", text.value},
                                  {"choices", json_of(choices)}};
    try {
        print(terminal, document_of_error);
        terminal.finish();
    } catch (const std::exception&) {
        // Standard output has failed: the message above reports it.
    }
    return code;
}

}  // namespace isoatlas::cli
