// isoatlas view FILE: a store behind a local address, and the page that explores it in a browser.
#include <cstdlib>
#include <thread>

#include <spawn.h>
#include <sys/wait.h>

#include "document.h"
#include "interrupt.h"
#include "store_beside.h"
#include "terminal.h"
#include "verbs.h"

namespace isoatlas::cli {
namespace {

/// Asks the desktop, where there is one, to open an address. Nothing happens elsewhere.
void open_in_browser(const std::string& address) {
    if (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr) return;
    std::string program = "xdg-open", word = address;
    char* words[] = {program.data(), word.data(), nullptr};
    pid_t process = 0;
    if (posix_spawnp(&process, program.c_str(), nullptr, nullptr, words, environ) == 0) waitpid(process, nullptr, 0);
}

void print_address(const Arguments& arguments, Terminal& terminal, const Server& server, const std::string& store) {
    if (arguments.json) {
        Json json = document("view");
        json["store"] = store;
        json["address"] = server.address();
        json["port"] = server.port();
        print(terminal, json);
    } else {
        terminal.out() << server.address() << '\n';
        terminal.next("open it in a browser; Ctrl-C ends the viewer");
    }
    terminal.out() << std::flush;
}

}  // namespace

int run_view(const Arguments& arguments, Terminal& terminal) {
    const std::string store = store_for(arguments, terminal, stem_of(arguments.file) + ".atlas");
    const Atlas atlas(store, {.cache_bytes = arguments.memory});
    Context context;
    context.threads = arguments.threads;
    Server server(atlas, {.port = arguments.port}, context);
    print_address(arguments, terminal, server, store);
    std::thread answering([&server] { server.run(); });
    if (!arguments.no_browser) open_in_browser(server.address());
    while (!interrupted()) std::this_thread::sleep_for(std::chrono::milliseconds(100));
    server.stop();
    answering.join();
    return 0;
}

}  // namespace isoatlas::cli
