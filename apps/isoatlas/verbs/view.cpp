// isoatlas view FILE: serves a store and its viewer page on a local address.
#include <cstdlib>
#include <optional>
#include <thread>

#include <malloc.h>
#include <poll.h>
#include <spawn.h>
#include <unistd.h>

#include "data/input.h"
#include "data/session.h"
#include "data/store_awaited.h"
#include "data/viewed.h"
#include "text/advice.h"
#include "text/document.h"
#include "text/interrupt.h"
#include "text/report.h"
#include "text/terminal.h"
#include "verbs/verbs.h"

namespace isoatlas::cli {
namespace {

/// Opens an address in the browser of the desktop, without waiting. Does nothing without a desktop.
void open_in_browser(const std::string& address) {
    if (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr) return;
    std::string program = "xdg-open", word = address;
    char* words[] = {program.data(), word.data(), nullptr};
    pid_t process = 0;
    (void)posix_spawnp(&process, program.c_str(), nullptr, nullptr, words, environ);
}

/// Is standard input an interactive terminal of this process group?
bool has_keyboard() { return ::isatty(STDIN_FILENO) == 1 && ::tcgetpgrp(STDIN_FILENO) == ::getpgrp(); }

void print_address(const Arguments& arguments, Terminal& terminal, Server& server, const std::string& store) {
    if (arguments.json) {
        Json json = document("view");
        json["store"] = store;
        json["address"] = server.address_for_one_use();
        json["server"] = server.address();
        json["port"] = server.port();
        print(terminal, json);
    } else {
        terminal.out() << server.address_for_one_use() << '\n';
        const std::string another = has_keyboard() ? "Enter" : "isoatlas ask " + server.address() + " /api/address";
        terminal.next("open it in a browser; it works once; " + another + " prints another one; Ctrl-C ends the viewer");
    }
    terminal.out() << std::flush;
}

/// Runs a server in a thread.
class Answering {
public:
    explicit Answering(Server& server) : server_(server), thread_([&server] { server.run(); }) {}
    Answering(const Answering&) = delete;
    Answering& operator=(const Answering&) = delete;
    ~Answering() {
        server_.stop();
        thread_.join();
    }

private:
    Server& server_;
    std::thread thread_;
};

/// Every arena of the allocator keeps the memory of its largest response: few arenas, not one for each connection.
void keep_memory_flat() { (void)::mallopt(M_ARENA_MAX, 2); }

Context context_of(const Arguments& arguments) {
    Context context;
    context.threads = arguments.threads;
    return context;
}

/// Prepares responses while the browser starts.
void prepare(Server& server) {
    Context context;
    context.cancelled = interrupted;
    server.prepare(context);
}

/// The token of the environment; else that of the links of the store.
ServerOptions server_options(const Arguments& arguments, const std::string& store) {
    const char* token = std::getenv("ISOATLAS_TOKEN");
    return {.port = arguments.port,
            .token = token == nullptr ? "" : token,
            .memory = arguments.memory,
            .is_read_only = arguments.read_only,
            .link = link_of_store(store, arguments.new_link)};
}

/// Without --scene an empty one.
SceneFile scene_of(const Arguments& arguments) { return arguments.scene.empty() ? SceneFile() : read_scene(arguments.scene); }

/// Is the scene one of the volume? Of a store that another process builds, the page says so.
void check_scene_of(const Arguments& arguments, const SceneFile& scene, const std::optional<Atlas>& atlas) {
    if (arguments.scene.empty()) return;
    if (atlas)
        check_scene(scene, atlas->info());
    else if (!arguments.file.ends_with(".atlas"))
        check_scene(scene, open_input(arguments).reader->info());
}

/// What a user should know of links that do not open, or will not.
void tell_of_links(const ServerOptions& options, const Server& server, Terminal& terminal) {
    if (!options.link.note.empty()) terminal.say("note: " + options.link.note);
    if (options.port != 0 || server.port() == options.link.port) return;
    terminal.say("note: port " + std::to_string(options.link.port) +
                 ", to which links to this store lead, is in use; this viewer has port " + std::to_string(server.port()));
}

void keep_token(Server& server, Terminal& terminal) {
    try {
        server.keep_token();
    } catch (const Error& error) {
        terminal.say(std::string("note: `isoatlas ask` cannot read the token of this viewer: ") + with_options(error).what());
    }
}

void tell_of_others(const Arguments& arguments, Terminal& terminal) {
    if (!arguments.several) return;
    const Channels& channels = arguments.several->channels;
    terminal.say("note: " + volume_text(channels, arguments.several->first) + "; the page has menus of all " +
                 std::to_string(channels.count()) + " volumes of the file");
}

/// Prints a new address at each Enter.
void wait_for_the_end(const Arguments& arguments, Terminal& terminal, Server& server) {
    constexpr int kLook = 100;  // milliseconds
    while (!interrupted()) {
        pollfd keyboard{.fd = has_keyboard() && !arguments.json ? STDIN_FILENO : -1, .events = POLLIN, .revents = 0};
        if (::poll(&keyboard, 1, kLook) <= 0 || (keyboard.revents & POLLIN) == 0) continue;
        char typed[256];
        if (::read(STDIN_FILENO, typed, sizeof typed) > 0) {
            terminal.out() << server.address_for_one_use() << '\n' << std::flush;
        } else {
            std::this_thread::sleep_for(std::chrono::milliseconds(kLook));  // end of input
        }
    }
}

}  // namespace

int run_view(const Arguments& arguments, Terminal& terminal) {
    Viewed viewed(arguments);
    keep_memory_flat();
    const SceneFile scene = scene_of(arguments);
    const std::string& store = viewed.store;
    for (const std::string& note : arguments.inputs.assumed) terminal.say("note: " + note);
    tell_of_others(arguments, terminal);
    if (is_ready(arguments, terminal, store)) {
        viewed.open();
        check_is_volume(arguments, viewed.atlas->info());
    }
    check_scene_of(arguments, scene, viewed.atlas);
    OtherVolumes others(arguments.several, terminal);
    ServerOptions server_choices = server_options(arguments, store);
    server_choices.scene = scene;
    if (arguments.several) {
        server_choices.channels = arguments.several->channels;
        server_choices.first = arguments.several->first;
        server_choices.wanted = [&others](std::int64_t volume) { others.want(volume); };
    }
    Server server(server_choices, context_of(arguments));
    tell_of_links(server_choices, server, terminal);
    keep_token(server, terminal);
    if (viewed.atlas) viewed.show(server);
    const Answering answering(server);
    print_address(arguments, terminal, server, store);
    if (!arguments.no_browser) open_in_browser(server.address_for_one_use());
    int code = 0;
    if (!viewed.atlas) {
        try {
            await_store(arguments, terminal, store, [&server](const BuildState& state) { server.report_progress(state); });
            viewed.open();
            viewed.show(server);
        } catch (const Error& error) {
            if (interrupted()) return 0;
            server.fail(with_options(error));  // the page shows it too
            code = report(error, {}, arguments.json, terminal);
            terminal.say("note: there is no store to show, see the page; Ctrl-C ends the viewer with exit code " + std::to_string(code));
        }
    }
    if (viewed.atlas) prepare(server);
    std::jthread opening;  // after the first volume: one build at a time
    if (arguments.several) opening = std::jthread([&](const std::stop_token& stop) { others.run(stop, server); });
    wait_for_the_end(arguments, terminal, server);
    return code;
}

}  // namespace isoatlas::cli
