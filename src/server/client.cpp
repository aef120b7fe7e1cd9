#include "isoatlas/client.h"

#include <httplib.h>

#include <charconv>
#include <optional>
#include <string_view>

#include <nlohmann/json.hpp>

#include "base/atomic_file.h"
#include "isoatlas/error.h"

namespace isoatlas {
namespace {

constexpr int kLongestAnswer = 3600;  ///< seconds: a large surface waits for its turn

struct Place {
    std::string host, token;
    int port = 0;
};

/// http://127.0.0.1:PORT/?token=TOKEN, taken apart.
std::optional<Place> place_of(std::string_view address) {
    constexpr std::string_view scheme = "http://", word = "/?token=";
    const std::size_t colon = address.find(':', scheme.size()), words = address.find(word);
    if (!address.starts_with(scheme) || colon >= words || words == std::string_view::npos) return std::nullopt;
    Place place{std::string(address.substr(scheme.size(), colon - scheme.size())), std::string(address.substr(words + word.size()))};
    const std::string_view port = address.substr(colon + 1, words - colon - 1);
    const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), place.port);
    const bool good = error == std::errc() && end == port.data() + port.size() && place.port > 0 && place.port < 65536;
    if (!good || (place.host != "127.0.0.1" && place.host != "localhost")) return std::nullopt;
    return place;
}

/// What the server said, as if it had happened here.
[[noreturn]] void refuse(int status, const std::string& body) {
    const nlohmann::json error = nlohmann::json::parse(body, nullptr, false).value("error", nlohmann::json::object());
    const int code = error.value("code", 0);
    if (code < 2 || code > 6) {
        throw Error(ErrorKind::input,
                    {.what = "the viewer answered " + std::to_string(status), .next = "docs/server.md says what may be asked"});
    }
    throw Error(static_cast<ErrorKind>(code), {.where = error.value("where", ""),
                                               .what = error.value("what", ""),
                                               .expected = error.value("expected", ""),
                                               .next = error.value("next", "")});
}

}  // namespace

ServerAnswer ask_server(const std::string& address, const std::string& question) {
    const std::optional<Place> place = place_of(address);
    if (!place) {
        throw Error(ErrorKind::usage, {.where = address.substr(0, 100),
                                       .what = "is no address of a viewer",
                                       .expected = "http://127.0.0.1:PORT/?token=TOKEN",
                                       .next = "give the address that `isoatlas view` printed, in quotes"});
    }
    if (!question.starts_with('/') || question.starts_with("/api/events")) {
        throw Error(ErrorKind::usage, {.where = question.substr(0, 100),
                                       .what = "is no question with an answer that ends",
                                       .expected = "a path such as '/api/objects?tau=100'",
                                       .next = "docs/server.md lists the questions"});
    }
    httplib::Client client(place->host, place->port);
    client.set_read_timeout(kLongestAnswer);
    const httplib::Result answer = client.Get(question, {{"Authorization", "Bearer " + place->token}, {"Accept-Encoding", "identity"}});
    if (!answer) {
        throw Error(ErrorKind::input, {.where = place->host + ":" + std::to_string(place->port),
                                       .what = "nobody answers: " + httplib::to_string(answer.error()),
                                       .next = "is `isoatlas view` still running? Start it again, and give its new address"});
    }
    if (answer->status != 200) refuse(answer->status, answer->body);
    return {answer->get_header_value("Content-Type"), answer->body};
}

std::size_t ask_server(const std::string& address, const std::string& question, const std::string& path) {
    const ServerAnswer answer = ask_server(address, question);
    AtomicFile file(path);
    file.write(answer.bytes);
    file.commit();
    return answer.bytes.size();
}

}  // namespace isoatlas
