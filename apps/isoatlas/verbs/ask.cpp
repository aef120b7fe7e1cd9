// isoatlas ask ADDRESS REQUEST: the response of a running viewer, on standard output or in a file.
#include "text/document.h"
#include "text/terminal.h"
#include "text/values.h"
#include "verbs/verbs.h"

namespace isoatlas::cli {
namespace {

/// Rejects addresses with a secret: every user of this machine sees the arguments of a command.
void refuse_secrets(const std::string& address) {
    const std::size_t path = address.find('/', address.find("//") == std::string::npos ? 0 : address.find("//") + 2);
    if (path == std::string::npos || address.find('?', path) == std::string::npos) return;
    const std::string server = address.substr(0, path);
    throw Error(ErrorKind::usage,
                {.where = server,
                 .what = "the address contains a secret, and every user of this machine sees the arguments of a command",
                 .expected = "the address up to its port: the token is in a file that only you can read, or in ISOATLAS_TOKEN",
                 .next = "isoatlas ask " + server + " REQUEST"});
}

}  // namespace

int run_ask(const Arguments& arguments, Terminal& terminal) {
    refuse_secrets(arguments.file);
    const std::string request = arguments.part.empty() ? "/api/atlas" : arguments.part.front();
    if (arguments.output.empty()) {
        const ServerResponse answer = ask_server(arguments.file, request);
        if (answer.type != "application/json") {
            throw Error(ErrorKind::usage,
                        {.where = request,
                         .what = "the response is " + bytes_text(static_cast<double>(answer.bytes.size())) + " of " + answer.type,
                         .next = "give a file for it: -o FILE"});
        }
        terminal.out() << answer.bytes << '\n';
        return 0;
    }
    check_output_file(arguments.output);
    const std::size_t bytes = ask_server(arguments.file, request, arguments.output);
    if (arguments.json) {
        Json json = document("ask");
        json["request"] = request;
        json["output"] = arguments.output;
        json["bytes"] = bytes;
        print(terminal, json);
    } else {
        terminal.out() << shown_name(arguments.output) << ": " << bytes_text(static_cast<double>(bytes)) << '\n';
    }
    return 0;
}

}  // namespace isoatlas::cli
