#include "server/connections.h"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>

namespace isoatlas::server {
namespace {

constexpr int kLook = 100;  ///< milliseconds: how often an idle connection asks whether the server still runs

thread_local int current = -1;

}  // namespace

int Connections::current_socket() { return current; }

bool Connections::is_gone(int socket) {
    pollfd asked{.fd = socket, .events = POLLRDHUP, .revents = 0};
    return ::poll(&asked, 1, 0) > 0 && asked.revents != 0;
}

bool Connections::has_question(socket_t socket) const {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point end = Clock::now() + std::chrono::seconds(keep_alive_timeout_sec_);
    while (svr_sock_ != INVALID_SOCKET && Clock::now() < end) {
        pollfd asked{.fd = socket, .events = POLLIN, .revents = 0};
        const int ready = ::poll(&asked, 1, kLook);
        if (ready != 0) return ready > 0 && (asked.revents & POLLIN) != 0;
    }
    return false;
}

bool Connections::process_and_close_socket(socket_t socket) {
    bool goes_on = true;
    for (std::size_t left = keep_alive_max_count_; goes_on && left > 0 && has_question(socket); --left) {
        goes_on = httplib::detail::process_client_socket(socket, read_timeout_sec_, read_timeout_usec_, write_timeout_sec_,
                                                         write_timeout_usec_, [&](httplib::Stream& stream) {
                                                             bool closed = false;
                                                             current = socket;
                                                             return process_request(stream, left == 1, closed, nullptr) && !closed;
                                                         });
        current = -1;
    }
    (void)::shutdown(socket, SHUT_RDWR);
    (void)::close(socket);
    return goes_on;
}

}  // namespace isoatlas::server
