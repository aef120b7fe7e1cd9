// isoatlas serve FOLDER: the files of a folder by HTTP, for isoatlas with an address.
#include <chrono>
#include <cstdlib>
#include <thread>

#include <isoatlas/folder_server.h>

#include "text/document.h"
#include "text/interrupt.h"
#include "text/terminal.h"
#include "verbs/verbs.h"

namespace isoatlas::cli {

int run_serve(const Arguments& arguments, Terminal& terminal) {
    constexpr std::chrono::milliseconds kLook{100};
    const char* token = std::getenv("ISOATLAS_BEARER_TOKEN");  // NOLINT(concurrency-mt-unsafe): nobody sets it
    FolderServer server(arguments.file, arguments.port, token == nullptr ? "" : token, arguments.reader);
    if (arguments.json) {
        Json json = document("serve");
        json["folder"] = arguments.file;
        json["address"] = server.address();
        json["port"] = server.port();
        print(terminal, json);
    } else {
        const std::string port = std::to_string(server.port());
        terminal.out() << server.address() << '\n';
        terminal.next("isoatlas view " + server.address() + "/FILE; from another machine after ssh -L " + port + ":127.0.0.1:" + port +
                      " HOST; Ctrl-C ends the server");
    }
    terminal.out() << std::flush;
    std::thread answering([&server] { server.run(); });
    while (!interrupted()) std::this_thread::sleep_for(kLook);
    server.stop();
    answering.join();
    return 0;
}

}  // namespace isoatlas::cli
