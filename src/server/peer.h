// The client at the other end of a connection, for the thread that answers it.
#pragma once

#include <cstddef>
#include <string_view>

namespace isoatlas {

/// Uses a socket owned by another object; no other thread may read or write it.
class Peer {
public:
    explicit Peer(int socket) : socket_(socket) {}

    /// Sends all bytes. False: the client has disconnected, or has received nothing for ten seconds. more: further bytes follow at once.
    [[nodiscard]] bool send(std::string_view bytes, bool more = false) const;
    /// Receives at most that many bytes; 0: closed by the other end, negative: error, or nothing for `timeout` milliseconds.
    [[nodiscard]] std::ptrdiff_t receive(char* bytes, std::size_t max, int timeout) const;
    /// Has the client closed the connection, or its own half of it?
    [[nodiscard]] bool is_gone() const;

private:
    int socket_;
};

}  // namespace isoatlas
