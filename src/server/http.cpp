// HTTP around the service: one door for every question, so that nothing is matched, mounted or redirected by the library.
#include <httplib.h>
#include <sys/random.h>

#include <array>

#include "isoatlas/error.h"
#include "isoatlas/server.h"
#include "server/coding.h"
#include "server/service.h"

namespace isoatlas {
namespace {

constexpr std::size_t kConnections = 72;          ///< at once: each keeps a thread that mostly waits
constexpr int kSlowClient = 10, kIdleClient = 5;  ///< seconds
constexpr std::size_t kLongestBody = 1 << 16, kQuestionsOfConnection = 1000;
constexpr std::size_t kWorthCoding = 512;  ///< bytes

std::string random_token() {
    std::array<unsigned char, 16> bytes;
    if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
        throw Error(ErrorKind::resource, {.what = "the system gives no random numbers"});
    std::string token;
    for (const unsigned char byte : bytes) {
        for (const int digit : {byte / 16, byte % 16}) token += "0123456789abcdef"[digit];
    }
    return token;
}

std::string bearer(const httplib::Request& request) {
    constexpr std::string_view scheme = "Bearer ";
    const std::string value = request.get_header_value("Authorization");
    return value.starts_with(scheme) ? value.substr(scheme.size()) : std::string();
}

}  // namespace

struct Server::Data {
    server::Service service;
    std::string token;
    httplib::Server http;
    int port = 0;

    Data(const Atlas& atlas, std::string secret, const Context& context) : service(atlas, secret, context), token(std::move(secret)) {}

    /// A page of another site that was led here by a changed name (DNS rebinding) sends its own name.
    [[nodiscard]] bool is_ours(const httplib::Request& request) const {
        const std::string host = request.get_header_value("Host"), at = ":" + std::to_string(port);
        return host == "127.0.0.1" + at || host == "localhost" + at;
    }

    void answer(const httplib::Request& request, httplib::Response& response) {
        response.set_header("X-Content-Type-Options", "nosniff");
        response.set_header("Referrer-Policy", "no-referrer");
        response.set_header("Cache-Control", "no-store");
        response.set_header(
            "Content-Security-Policy",
            "default-src 'none'; script-src 'unsafe-inline' 'wasm-unsafe-eval'; style-src 'unsafe-inline'; connect-src 'self'; "
            "img-src data: blob:; frame-ancestors 'none'; base-uri 'none'; form-action 'none'");
        if (!is_ours(request) || (request.method != "GET" && request.method != "HEAD")) {
            response.status = is_ours(request) ? 405 : 421;
            return;
        }
        server::Question question{
            request.path, {request.params.begin(), request.params.end()}, bearer(request), request.get_header_value("X-Client")};
        if (question.path == "/") question.words.clear();
        const server::Answer answer = service.answer(question);
        response.status = answer.status;
        for (const auto& [name, value] : answer.headers) response.set_header(name, value);
        const std::string_view coding =
            answer.bytes.size() < kWorthCoding ? std::string_view() : server::coding_for(request.get_header_value("Accept-Encoding"));
        response.set_header("Vary", "Accept-Encoding");
        if (!coding.empty()) response.set_header("Content-Encoding", std::string(coding));
        // A provider of known length: the library would code a text once more.
        const auto bytes = std::make_shared<const std::string>(server::coded(answer.bytes, coding));
        response.set_content_provider(bytes->size(), answer.type, [bytes](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
            return sink.write(bytes->data() + offset, length);
        });
    }
};

Server::Server(const Atlas& atlas, const ServerOptions& options, const Context& context)
    : data_(std::make_unique<Data>(atlas, options.token.empty() ? random_token() : options.token, context)) {
    httplib::Server& http = data_->http;
    http.new_task_queue = [] { return new httplib::ThreadPool(kConnections); };  // the library deletes it
    http.set_socket_options([](socket_t) {});  // its own would let another process listen on the same port
    http.set_tcp_nodelay(true);
    http.set_read_timeout(kSlowClient);
    http.set_write_timeout(kSlowClient);
    http.set_keep_alive_timeout(kIdleClient);
    http.set_keep_alive_max_count(kQuestionsOfConnection);
    http.set_payload_max_length(kLongestBody);
    http.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
        data_->answer(request, response);
        return httplib::Server::HandlerResponse::Handled;
    });
    if (options.port == 0) {
        data_->port = http.bind_to_any_port("127.0.0.1");
    } else if (http.bind_to_port("127.0.0.1", options.port)) {
        data_->port = options.port;
    }
    if (data_->port > 0) return;
    throw Error(ErrorKind::resource, {.where = "port " + std::to_string(options.port),
                                      .what = "it cannot be listened on",
                                      .next = "choose another one with --port, or leave it away"});
}

Server::~Server() { stop(); }

int Server::port() const { return data_->port; }

std::string Server::address() const { return "http://127.0.0.1:" + std::to_string(data_->port) + "/?token=" + data_->token; }

void Server::run() { data_->http.listen_after_bind(); }

void Server::stop() {
    data_->service.end();
    data_->http.stop();
}

}  // namespace isoatlas
