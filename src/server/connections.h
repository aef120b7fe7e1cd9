// The library's server, with what it does not tell a handler: whether the client is still there.
#pragma once

#include <httplib.h>

namespace isoatlas::server {

class Connections : public httplib::Server {
public:
    /// For handlers: the connection of the question that this thread answers.
    [[nodiscard]] static int current_socket();
    /// Has the client closed it, or its own half of it?
    [[nodiscard]] static bool is_gone(int socket);

private:
    bool process_and_close_socket(socket_t socket) override;
    [[nodiscard]] bool has_question(socket_t socket) const;
};

}  // namespace isoatlas::server
