#include "isoatlas/client.h"

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string_view>

#include <nlohmann/json.hpp>

#include "base/atomic_file.h"
#include "base/private_file.h"
#include "isoatlas/error.h"
#include "server/peer.h"
#include "server/response_reader.h"
#include "server/token_file.h"

namespace isoatlas {
namespace {

constexpr int kLongestAnswer = 3'600'000;  ///< milliseconds without a byte: the job of a large surface may wait
constexpr std::size_t kPiece = 1 << 16;

struct Place {
    std::string token{};
    int port = 0;
};

/// http://127.0.0.1:PORT, with or without /?token=TOKEN, or PORT, taken apart.
std::optional<Place> place_of(std::string_view address) {
    constexpr std::string_view word = "/?token=";
    for (const std::string_view start : {"http://127.0.0.1:", "http://localhost:"}) {
        if (address.starts_with(start)) address.remove_prefix(start.size());
    }
    const std::string_view port = address.substr(0, address.find('/'));
    address.remove_prefix(port.size());
    Place place;
    if (address.starts_with(word)) place.token = address.substr(word.size());
    const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), place.port);
    const bool good = error == std::errc() && end == port.data() + port.size() && place.port > 0 && place.port < 65536;
    if (!good || (place.token.empty() && !address.empty() && address != "/")) return std::nullopt;
    return place;
}

/// Printable, without a space: valid in a request.
bool is_plain(std::string_view text) {
    return std::ranges::all_of(text, [](char letter) { return letter > ' ' && letter < 127; });
}

std::string token_of(const Place& place) {
    if (!place.token.empty()) return place.token;
    if (const char* told = std::getenv("ISOATLAS_TOKEN"); told != nullptr && *told != '\0') return told;
    std::string kept = private_text(token_file(place.port));
    while (!kept.empty() && kept.back() == '\n') kept.pop_back();
    if (!kept.empty()) return kept;
    throw Error(ErrorKind::input, {.where = "127.0.0.1:" + std::to_string(place.port),
                                   .what = "no viewer of this user is known on this port: no token found",
                                   .next = "is the viewer still running? Start it again and use its new address; the token of another "
                                           "user's viewer can be set as ISOATLAS_TOKEN",
                                   .reason = Reason::no_token});
}

[[noreturn]] void refuse_silence(int port, const std::string& why) {
    throw Error(ErrorKind::input, {.where = "127.0.0.1:" + std::to_string(port),
                                   .what = "no response: " + why,
                                   .next = "is the viewer still running? Start it again and use its new address",
                                   .reason = Reason::no_server});
}

/// Connected to a port of this machine.
class Socket {
public:
    explicit Socket(int port) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
        sockaddr_in there{};
        there.sin_family = AF_INET;
        there.sin_port = htons(static_cast<std::uint16_t>(port));
        there.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        if (socket_ >= 0 && ::connect(socket_, reinterpret_cast<const sockaddr*>(&there), sizeof there) == 0) return;
        const std::string why = std::strerror(errno);
        if (socket_ >= 0) (void)::close(socket_);
        refuse_silence(port, why);
    }
    Socket(const Socket&) = delete;
    Socket& operator=(const Socket&) = delete;
    ~Socket() { (void)::close(socket_); }

    [[nodiscard]] Peer peer() const { return Peer(socket_); }

private:
    int socket_;
};

void get(const Place& place, const std::string& request, ResponseReader& answer) {
    const std::string token = token_of(place);
    if (!is_plain(token))
        throw Error(ErrorKind::usage, {.where = "the token", .what = "contains a character that is not valid in a token"});
    const Socket socket(place.port);
    const std::string head = "GET " + request + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(place.port) +
                             "\r\nAuthorization: Bearer " + token + "\r\nConnection: close\r\n\r\n";
    const bool sent = socket.peer().send(head);
    std::string bytes(kPiece, '\0');
    while (!answer.is_whole()) {
        const std::ptrdiff_t count = socket.peer().receive(bytes.data(), bytes.size(), sent ? kLongestAnswer : 0);
        if (count <= 0) refuse_silence(place.port, "the response is incomplete");
        if (!answer.read(std::string_view(bytes).substr(0, static_cast<std::size_t>(count)))) refuse_silence(place.port, "not a viewer");
    }
}

/// Rethrows the error of the response.
[[noreturn]] void refuse(int status, const std::string& body) {
    const nlohmann::json told = nlohmann::json::parse(body, nullptr, false);
    const nlohmann::json error = told.is_object() ? told.value("error", nlohmann::json::object()) : nlohmann::json::object();
    const int code = error.value("code", 0);
    if (code < 2 || code > 6) {
        throw Error(ErrorKind::input, {.what = "the viewer responded with status " + std::to_string(status), .next = "see docs/server.md"});
    }
    throw Error(static_cast<ErrorKind>(code), {.where = error.value("where", ""),
                                               .what = error.value("what", ""),
                                               .expected = error.value("expected", ""),
                                               .next = error.value("next", ""),
                                               .reason = reason_of(error.value("reason", "")).value_or(Reason::none),
                                               .value = error.value("value", "")});
}

}  // namespace

ServerResponse ask_server(const std::string& address, const std::string& request) {
    const std::optional<Place> place = place_of(address);
    if (!place) {
        throw Error(ErrorKind::usage, {.where = address.substr(0, 100),
                                       .what = "not an address of a viewer",
                                       .expected = "http://127.0.0.1:PORT",
                                       .next = "use the address that the viewer printed, up to its port",
                                       .reason = Reason::not_an_address});
    }
    if (!request.starts_with('/') || request.starts_with("/api/events") || !is_plain(request)) {
        throw Error(ErrorKind::usage, {.where = request.substr(0, 100),
                                       .what = "not a request with a finite response",
                                       .expected = "a path such as '/api/objects?tau=100'",
                                       .next = "docs/server.md lists the requests"});
    }
    ResponseReader answer;
    get(*place, request, answer);
    if (answer.status() != 200) refuse(answer.status(), answer.body());
    return {answer.type(), std::move(answer.body())};
}

std::size_t ask_server(const std::string& address, const std::string& request, const std::string& path) {
    const ServerResponse answer = ask_server(address, request);
    AtomicFile file(path);
    file.write(answer.bytes);
    file.commit();
    return answer.bytes.size();
}

}  // namespace isoatlas
