#include "server/peer.h"

#include <poll.h>
#include <sys/socket.h>

#include <cerrno>

namespace isoatlas {
namespace {

constexpr int kSlowClient = 10'000;  ///< milliseconds

/// timeout: in milliseconds.
bool waits_for(int socket, short what, int timeout) {
    pollfd asked{.fd = socket, .events = what, .revents = 0};
    while (true) {
        const int ready = ::poll(&asked, 1, timeout);
        if (ready >= 0 || errno != EINTR) return ready > 0;
    }
}

}  // namespace

bool Peer::send(std::string_view bytes, bool more) const {
    while (!bytes.empty()) {
        const ssize_t count = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT | (more ? MSG_MORE : 0));
        if (count > 0) bytes.remove_prefix(static_cast<std::size_t>(count));
        if (count >= 0 || errno == EINTR) continue;
        if (errno != EAGAIN || !waits_for(socket_, POLLOUT, kSlowClient)) return false;
    }
    return true;
}

std::ptrdiff_t Peer::receive(char* bytes, std::size_t max, int timeout) const {
    while (true) {
        if (!waits_for(socket_, POLLIN, timeout)) return -1;
        const ssize_t count = ::recv(socket_, bytes, max, MSG_DONTWAIT);
        if (count >= 0 || (errno != EINTR && errno != EAGAIN)) return count;
    }
}

bool Peer::is_gone() const {
    pollfd asked{.fd = socket_, .events = POLLRDHUP, .revents = 0};
    return ::poll(&asked, 1, 0) > 0 && asked.revents != 0;
}

}  // namespace isoatlas
