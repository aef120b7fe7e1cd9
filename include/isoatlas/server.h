// Server: a store behind a local address, for the viewer in a browser and for programs.
#pragma once

#include <memory>
#include <string>

#include "isoatlas/atlas.h"
#include "isoatlas/context.h"

namespace isoatlas {

struct ServerOptions {
    int port = 0;         ///< 1 to 65535; 0: any that is free
    std::string token{};  ///< what every question must carry; empty: 128 random bits
};

/// Listens on 127.0.0.1 alone. Questions and answers: docs/server.md.
class Server {
public:
    /// The atlas must live as long as this. Throws Error{resource} when the port is taken.
    explicit Server(const Atlas& atlas, const ServerOptions& options = {}, const Context& context = {});
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;
    ~Server();

    [[nodiscard]] int port() const;
    /// The page with the token: http://127.0.0.1:PORT/?token=TOKEN
    [[nodiscard]] std::string address() const;
    /// Answers until stop() is called.
    void run();
    /// From any thread; what is being answered is ended.
    void stop();

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

}  // namespace isoatlas
