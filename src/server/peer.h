// The client at the other end of a connection, for the thread that answers it.
#pragma once

#include <cstddef>
#include <string_view>

namespace isoatlas {

/// Of a socket that another object owns, and that nobody else reads or writes meanwhile.
class Peer {
public:
    explicit Peer(int socket) : socket_(socket) {}

    /// All bytes. False: the client has gone, or has taken nothing for ten seconds. more: others follow at once.
    [[nodiscard]] bool send(std::string_view bytes, bool more = false) const;
    /// At most so many bytes of what has come; 0: the other end is closed, negative: nothing came in time, or an error.
    [[nodiscard]] std::ptrdiff_t receive(char* bytes, std::size_t max, int milliseconds) const;
    /// Has it closed the connection, or its own half of it?
    [[nodiscard]] bool is_gone() const;

private:
    int socket_;
};

}  // namespace isoatlas
