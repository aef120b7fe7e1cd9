// HTTP around the service: one door for every question, so that nothing is matched, mounted or redirected by the library.
#include <sched.h>
#include <sys/random.h>

#include <array>
#include <atomic>

#include "base/memory_limit.h"
#include "isoatlas/error.h"
#include "isoatlas/server.h"
#include "server/answers.h"
#include "server/coding.h"
#include "server/connections.h"
#include "server/service.h"

namespace isoatlas {
namespace {

constexpr std::size_t kConnections = 160;         ///< at once: each keeps a thread that mostly waits
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

/// Of every answer.
constexpr std::pair<const char*, const char*> kHeaders[] = {
    {"X-Content-Type-Options", "nosniff"},
    {"Referrer-Policy", "no-referrer"},
    {"Cache-Control", "no-store"},
    {"Content-Security-Policy",
     "default-src 'none'; script-src 'unsafe-inline' 'wasm-unsafe-eval'; style-src 'unsafe-inline'; connect-src 'self'; "
     "img-src data: blob:; frame-ancestors 'none'; base-uri 'none'; form-action 'none'"}};

}  // namespace

struct Server::Data {
    server::Service service;
    std::string token;
    server::Connections http;
    int port = 0;
    std::atomic<bool> runs = false, ends = false;
    const std::int64_t most_on_its_way;  ///< bytes that clients may be slow to take
    std::shared_ptr<std::atomic<std::int64_t>> on_its_way = std::make_shared<std::atomic<std::int64_t>>(0);

    Data(std::string secret, const ServerOptions& options, const Context& context)
        : service(secret, context, options.memory),
          token(std::move(secret)),
          most_on_its_way(options.memory > 0 ? options.memory : available_memory() / 4) {}

    /// A page of another site that was led here by a changed name (DNS rebinding) sends its own name.
    [[nodiscard]] bool is_ours(const httplib::Request& request) const {
        const std::string host = request.get_header_value("Host"), at = ":" + std::to_string(port);
        return host == "127.0.0.1" + at || host == "localhost" + at;
    }

    void answer(const httplib::Request& request, httplib::Response& response) {
        for (const auto& [name, value] : kHeaders) response.set_header(name, value);
        if (!is_ours(request) || (request.method != "GET" && request.method != "HEAD")) {
            response.status = is_ours(request) ? 405 : 421;
            return;
        }
        server::Question question{request.path,
                                  {request.params.begin(), request.params.end()},
                                  bearer(request),
                                  request.get_header_value("X-Client"),
                                  [socket = server::Connections::current_socket()] { return server::Connections::is_gone(socket); }};
        if (question.path == "/") question.words.clear();
        server::Answer answer = *on_its_way > most_on_its_way ? too_much() : service.answer(question);
        response.status = answer.status;
        for (const auto& [name, value] : answer.headers) response.set_header(name, value);
        if (answer.events) return send_events(answer, response);
        send(std::move(answer), server::coding_for(request.get_header_value("Accept-Encoding")), response);
    }

    static server::Answer too_much() {
        return {503, "application/json",
                server::error_json(Error(ErrorKind::resource, {.what = "too much is on its way to clients", .next = "ask again later"}))};
    }

    void send(server::Answer answer, std::string_view coding, httplib::Response& response) const {
        response.set_header("Vary", "Accept-Encoding");
        if (answer.bytes.size() < kWorthCoding) coding = {};
        if (!coding.empty()) {
            response.set_header("Content-Encoding", std::string(coding));
            answer.bytes = server::coded(answer.bytes, coding);
        }
        const auto size = static_cast<std::int64_t>(answer.bytes.size());
        *on_its_way += size;
        const std::shared_ptr<const std::string> bytes(new std::string(std::move(answer.bytes)),
                                                       [counter = on_its_way, size](const std::string* sent) {
                                                           *counter -= size;
                                                           delete sent;
                                                       });
        // A provider of known length: the library would code a text once more.
        response.set_content_provider(bytes->size(), answer.type, [bytes](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
            return sink.write(bytes->data() + offset, length);
        });
    }

    static void send_events(const server::Answer& answer, httplib::Response& response) {
        response.set_chunked_content_provider(answer.type, [events = answer.events](std::size_t, httplib::DataSink& sink) {
            const std::string message = events->next();
            if (message.empty()) sink.done();
            return message.empty() || sink.write(message.data(), message.size());
        });
    }
};

Server::Server(const ServerOptions& options, const Context& context)
    : data_(std::make_unique<Data>(options.token.empty() ? random_token() : options.token, options, context)) {
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

void Server::run() {
    data_->runs = true;
    if (!data_->ends) data_->http.listen_after_bind();
    data_->runs = false;
}

void Server::stop() {
    data_->ends = true;
    data_->service.end();
    while (data_->runs && !data_->http.is_running()) (void)::sched_yield();  // the library stops only what listens
    data_->http.stop();
}

void Server::open(const Atlas& atlas) { data_->service.opening().open(atlas); }
void Server::prepare(const Context& context) {
    try {
        data_->service.prepare(context);
    } catch (const Error&) {  // who asks is told
    }
}
void Server::tell(const BuildState& state) { data_->service.opening().tell(state); }
void Server::fail(const Error& error) { data_->service.opening().fail(error); }

}  // namespace isoatlas
