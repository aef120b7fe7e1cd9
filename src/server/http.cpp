// HTTP around the service: one entry point for all requests; no library routes, mounts or redirects them.
#include <algorithm>
#include <atomic>
#include <cctype>
#include <new>

#include "base/memory_limit.h"
#include "base/private_file.h"
#include "isoatlas/error.h"
#include "isoatlas/server.h"
#include "server/access_control.h"
#include "server/answers.h"
#include "server/coding.h"
#include "server/network.h"
#include "server/query_parameters.h"
#include "server/response.h"
#include "server/secret.h"
#include "server/target.h"
#include "server/token_file.h"
#include "server/volume_services.h"

namespace isoatlas {
namespace {

constexpr std::size_t kWorthCoding = 512;                  ///< bytes
constexpr std::string_view kPageHead = "<head>";           ///< of the page
constexpr std::size_t kShortToken = 16, kLongToken = 256;  ///< letters

std::string checked_token(const std::string& token) {
    const bool good = token.size() >= kShortToken && token.size() <= kLongToken &&
                      std::ranges::all_of(token, [](unsigned char letter) { return std::isalnum(letter) != 0; });
    if (token.empty()) return random_secret();
    if (!good) throw Error(ErrorKind::usage, {.where = "the token", .what = "invalid", .expected = "16 to 256 letters and digits"});
    return token;
}

/// Bytes of a response that a slow client has not received yet.
class OnItsWay {
public:
    OnItsWay(std::atomic<std::int64_t>& sum, std::size_t size) : sum_(sum), size_(static_cast<std::int64_t>(size)) { sum_ += size_; }
    OnItsWay(const OnItsWay&) = delete;
    OnItsWay& operator=(const OnItsWay&) = delete;
    ~OnItsWay() { sum_ -= size_; }

private:
    std::atomic<std::int64_t>& sum_;
    const std::int64_t size_;
};

}  // namespace

struct Server::Data {
    const std::string token;
    VolumeServices services;
    const std::int64_t most_on_its_way;
    std::atomic<std::int64_t> on_its_way = 0;
    std::optional<PrivateFile> kept{};
    Network network;
    AccessControl access;

    Data(const ServerOptions& options, const Context& context)
        : token(checked_token(options.token.empty() ? options.link.token : options.token)),
          services(token, options, context),
          most_on_its_way(options.memory > 0 ? options.memory : available_memory() / 4),
          network(
              options.port > 0 ? options.port : options.link.port, options.port == 0,
              {.at_the_door = [this](const RequestHead& head) { return access.answer(head); },
               .refusal = AccessControl::refusal,
               .answer = [this](const RequestHead& head, const std::string& body, const Peer& peer) { return answer(head, body, peer); }}),
          access(network.port(), {token, options.link.cookie, options.link.key, options.link.is_kept}) {}

    /// An authorised request. True: another request may follow.
    bool answer(const RequestHead& head, const std::string& body, const Peer& peer) {
        const VolumeTarget of_volume = volume_target_of(head.target);
        Target target = target_of(of_volume.rest);
        if (target.path == "/") target.words.clear();
        const Request request{
            target.path, std::move(target.words), token, head.client, [peer] { return peer.is_gone(); }, head.method == "PUT", body};
        try {
            if (request.path == "/frame") return send_frame(head, peer);
            if (on_its_way > most_on_its_way) return send(head, too_much(), peer);
            if (request.path == "/api/address") return send(head, new_address(request), peer);
            if (!services.has(of_volume.volume)) return send(head, refused(404, services.no_such_volume(of_volume.volume)), peer);
            const VolumeServices::Use service = services.use(of_volume.volume, request.path == "/");
            if (request.path == "/api/volumes") return send(head, volumes(request, of_volume.volume), peer);
            Response answer = service->answer(request);
            if (answer.events) return send_events(head, answer, peer);
            return send(head, std::move(answer), peer);
        } catch (const std::bad_alloc&) {  // nothing has been sent
            (void)peer.send(AccessControl::refusal(503));
            return false;
        }
    }

    static Response refused(int status, const Error& error) { return {status, "application/json", error_json(error)}; }
    static Response too_much() {
        return refused(503, Error(ErrorKind::resource, {.what = "too many bytes are being sent to clients", .next = "retry later"}));
    }

    Response volumes(const Request& request, std::optional<std::int64_t> volume) const {
        try {
            QueryParameters(request.words).reject_unknown();
            return {200, "application/json", volumes_json(services.channels(), services.number_of(volume))};
        } catch (const Error& error) {
            return refused(400, error);
        }
    }

    Response new_address(const Request& request) {
        try {
            QueryParameters words(request.words);
            const bool is_for_frame = words.choice("for", {"tab", "frame"}) == "frame";
            words.reject_unknown();
            return {200, "application/json", address_json(is_for_frame ? access.address_for_one_frame() : access.address_for_one_use())};
        } catch (const Error& error) {
            return refused(error.kind() == ErrorKind::usage ? 400 : 503, error);
        }
    }

    /// The page, with a key of its own in its head: its requests need no cookie.
    bool send_frame(const RequestHead& head, const Peer& peer) {
        const std::optional<std::string> key = access.open_frame(head.target);
        if (!key) {
            (void)peer.send(AccessControl::refused_frame());  // another request has used it meanwhile
            return false;
        }
        Response page = services.first()->answer({"/", {}, token, head.client});
        if (const std::size_t place = page.bytes.find(kPageHead); place != std::string::npos)
            page.bytes.insert(place + kPageHead.size(), "<meta name=\"isoatlas-frame\" content=\"" + *key + "\">");
        page.may_be_framed = true;
        return send(head, std::move(page), peer);
    }

    bool send(const RequestHead& head, Response answer, const Peer& peer) {
        const std::string_view coding = answer.bytes.size() < kWorthCoding ? std::string_view() : coding_for(head.accept_encoding);
        if (!coding.empty()) answer.bytes = coded(answer.bytes, coding);
        ResponseHead response{answer.status, answer.type, answer.bytes.size()};
        response.fields = {{"Vary", "Accept-Encoding"}};
        if (!coding.empty()) response.fields.emplace_back("Content-Encoding", coding);
        response.fields.insert(response.fields.end(), answer.headers.begin(), answer.headers.end());
        response.keep_alive = head.keep_alive;
        response.may_be_framed = answer.may_be_framed;
        const OnItsWay counted(on_its_way, answer.bytes.size());
        const bool is_whole = head.method != "HEAD";
        return peer.send(text_of(response), is_whole) && (!is_whole || peer.send(answer.bytes)) && head.keep_alive;
    }

    static bool send_events(const RequestHead& head, const Response& answer, const Peer& peer) {
        const ResponseHead response{.type = answer.type, .length = {}, .is_old = head.is_old};
        if (!peer.send(text_of(response)) || head.method == "HEAD") return false;
        while (true) {
            const std::string message = answer.events->next();
            const std::string piece = head.is_old ? message : chunk(message);
            if (!peer.send(piece) || message.empty()) return false;
        }
    }
};

Server::Server(const ServerOptions& options, const Context& context) : data_(std::make_unique<Data>(options, context)) {}

Server::~Server() { stop(); }

int Server::port() const { return data_->network.port(); }
std::string Server::address() const { return data_->access.address(); }
const std::string& Server::token() const { return data_->token; }
std::string Server::address_for_one_use() { return data_->access.address_for_one_use(); }
void Server::keep_token() { data_->kept.emplace(token_file(port()), data_->token + "\n"); }

void Server::run() { data_->network.run(); }

void Server::stop() {
    data_->services.end();
    data_->network.stop();
}

void Server::open(const Atlas& atlas, const Atlas* low, VolumeNumber volume) {
    data_->services.use(volume)->store_state().open(atlas, low);
}
bool Server::close(std::int64_t volume) { return data_->services.close(volume); }
void Server::prepare(const Context& context, VolumeNumber volume) {
    try {
        data_->services.use(volume)->prepare(context);
    } catch (const Error&) {           // the client receives the error
    } catch (const std::bad_alloc&) {  // a request tries again
    }
}
std::string Server::address_for_one_frame() { return data_->access.address_for_one_frame(); }
std::string Server::scene() const { return data_->services.first()->scene(); }
void Server::set_scene(const std::string& text) { data_->services.first()->set_scene(text); }
void Server::report_progress(const BuildState& state, VolumeNumber volume) {
    data_->services.use(volume)->store_state().report_progress(state);
}
void Server::fail(const Error& error, VolumeNumber volume) { data_->services.use(volume)->store_state().fail(error); }

}  // namespace isoatlas
