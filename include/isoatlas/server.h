// Server: a store behind a local address, for the viewer in a browser and for programs.
#pragma once

#include <memory>
#include <string>

#include "isoatlas/atlas.h"
#include "isoatlas/build.h"
#include "isoatlas/context.h"
#include "isoatlas/error.h"

namespace isoatlas {

struct ServerOptions {
    int port = 0;             ///< 1 to 65535; 0: any that is free
    std::string token{};      ///< what the questions of programs must carry, 16 to 256 letters and digits; empty: 128 random bits
    std::int64_t memory = 0;  ///< bytes for answers that are being made or sent at a time; 0: a quarter of what there is
};

/// Listens on 127.0.0.1 alone. Questions and answers: docs/server.md. Writes nothing to any disk but what keep_token() does.
class Server {
public:
    /// There is no store yet: see open(). Throws Error: resource (the port is taken), usage (no such token can be used).
    explicit Server(const ServerOptions& options = {}, const Context& context = {});
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;
    ~Server();

    [[nodiscard]] int port() const;
    /// For programs, which carry the token beside it: http://127.0.0.1:PORT
    [[nodiscard]] std::string address() const;
    [[nodiscard]] const std::string& token() const;
    /// A new address that opens the page in one browser: good once, for ten minutes; 16 are good at a time, the oldest ends. From any
    /// thread.
    [[nodiscard]] std::string address_for_one_use();
    /// Keeps the token in a file of this user alone, where ask_server() finds it, as long as this lives: viewer-PORT in
    /// $XDG_RUNTIME_DIR/isoatlas, else $XDG_CACHE_HOME/isoatlas or ~/.cache/isoatlas. Throws Error{resource}.
    void keep_token();
    /// Answers until stop() is called.
    void run();
    /// From any thread; what is being answered is ended.
    void stop();

    // From any thread: what those who have the page open see.
    /// From now on questions are answered from this store, which must live as long as this.
    void open(const Atlas& atlas);
    /// Finds what every page asks first, from the store that is open, so that nobody waits for it; returns when it is found, cannot be
    /// found, or stop() was called. Those who ask meanwhile wait for the same. Cost: the trees are read.
    void prepare(const Context& context = {});
    /// The store is being built.
    void report_progress(const BuildState& state);
    /// There will be no store. Another tell() or open() takes it back.
    void fail(const Error& error);

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

}  // namespace isoatlas
