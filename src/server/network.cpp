#include "server/network.h"

#include <sched.h>
#include <sys/socket.h>

#include <array>
#include <atomic>
#include <cstddef>
#include <list>
#include <new>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>

#include "base/workers.h"
#include "isoatlas/error.h"

namespace isoatlas {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kTick{200};  ///< interval of checking deadlines
constexpr std::size_t kMaxDrained = 1 << 16;     ///< max bytes of a request that are discarded

struct Connection;
using Connected = std::list<std::shared_ptr<Connection>>;

struct Connection {
    explicit Connection(tcp::socket accepted) : socket(std::move(accepted)) {}

    tcp::socket socket;
    Connected* list = nullptr;  ///< in the list of connections; none: closed
    Connected::iterator place{};
    Clock::time_point until{};
    std::string bytes{};  ///< received and not yet parsed, at most kLongestHead
    std::optional<HeadReader> reader{};
    bool leaves = false;      ///< received bytes are discarded
    std::size_t drained = 0;  ///< bytes discarded
    /// Memory of the handler at the end of its response, which must be told even where no memory is left.
    alignas(std::max_align_t) std::array<std::byte, 256> reserved{};
};
using ConnectionPointer = std::shared_ptr<Connection>;

/// Gives the reserved memory of a connection, to one handler at a time.
template <class T>
struct ReservedMemory {
    using value_type = T;
    Connection* connection;

    explicit ReservedMemory(Connection* of) : connection(of) {}
    template <class Other>
    explicit(false) ReservedMemory(const ReservedMemory<Other>& other) : connection(other.connection) {}
    [[nodiscard]] T* allocate(std::size_t count) const {
        if (count * sizeof(T) > connection->reserved.size()) throw std::bad_alloc();
        return reinterpret_cast<T*>(connection->reserved.data());
    }
    void deallocate(T*, std::size_t) const {}
    template <class Other>
    bool operator==(const ReservedMemory<Other>& other) const {
        return connection == other.connection;
    }
};

/// Called on the thread of the network after a response.
template <class Call>
struct AfterResponse {
    using allocator_type = ReservedMemory<std::byte>;  // NOLINT(readability-identifier-naming): Asio looks for it
    ConnectionPointer connection;
    Call call;

    [[nodiscard]] allocator_type get_allocator() const { return allocator_type(connection.get()); }
    void operator()() const { call(connection); }
};

struct Counted {
    explicit Counted(std::atomic<int>& of) : count(of), before(of.fetch_add(1)) {}
    Counted(const Counted&) = delete;
    Counted& operator=(const Counted&) = delete;
    ~Counted() { --count; }
    std::atomic<int>& count;
    const int before;
};

/// Closes a connection, which may be closed already.
void ignore(const error_code&) {}

}  // namespace

class Network::Connections {
public:
    Connections(int port, bool or_any, Answers answers) : answers_(std::move(answers)) {
        if (!listens(port) && !(or_any && listens(0))) {
            throw Error(ErrorKind::resource, {.where = "port " + std::to_string(port),
                                              .what = "cannot listen on this port",
                                              .next = "choose another one, or let the system choose",
                                              .reason = Reason::port_in_use});
        }
    }

    [[nodiscard]] int port() const { return acceptor_.local_endpoint().port(); }

    void run() {
        while (!ended_) {
            try {
                if (!accepting_) accept();
                if (!ticking_) tick();
                io_.run();
            } catch (const std::exception&) {  // std::bad_alloc: its deadline closes the connection
                (void)::sched_yield();
            }
        }
        // Connections with a response: nothing more is sent, and they are closed.
        for (const ConnectionPointer& connection : busy_) (void)::shutdown(connection->socket.native_handle(), SHUT_RDWR);
        workers_.wait();
    }

    void stop() {
        ended_ = true;
        io_.stop();
    }

private:
    bool listens(int port) {
        try {
            const tcp::endpoint here(asio::ip::address_v4::loopback(), static_cast<std::uint16_t>(port));
            if (acceptor_.is_open()) acceptor_.close();
            acceptor_.open(here.protocol());
            acceptor_.set_option(asio::socket_base::reuse_address(true));  // Linux: two sockets never listen at once
            acceptor_.bind(here);
            acceptor_.listen();
            acceptor_.non_blocking(true);
            return true;
        } catch (const boost::system::system_error&) {
            return false;
        }
    }

    void tick() {
        timer_.expires_after(kTick);
        timer_.async_wait([this](error_code) {
            ticking_ = false;
            tick();
            if (!accepting_) accept();
            const Clock::time_point now = Clock::now();
            for (Connected* list : {&strangers_, &idle_}) {
                for (auto each = list->begin(); each != list->end();) {
                    const ConnectionPointer connection = *each++;
                    if (connection->until <= now) cut_off(*connection);
                }
            }
        });
        ticking_ = true;
    }

    void accept() {
        acceptor_.async_accept([this](error_code error, tcp::socket socket) {
            accepting_ = false;
            if (error) {  // no file descriptor left, or closed by the client: the next tick retries
                cut_off_oldest(strangers_.empty() ? idle_ : strangers_);
                return;
            }
            const ConnectionPointer connection = std::make_shared<Connection>(std::move(socket));
            if (std::ssize(strangers_) >= kMaxStrangers) cut_off_oldest(strangers_);
            connection->place = strangers_.insert(strangers_.end(), connection);
            connection->list = &strangers_;
            connection->until = Clock::now() + kHeadTime;
            connection->socket.non_blocking(true);
            connection->socket.set_option(tcp::no_delay(true));
            accept();
            read(connection);
        });
        accepting_ = true;
    }

    void drop(Connection& connection) {
        error_code error;
        ignore(connection.socket.close(error));
        if (connection.list != nullptr) connection.list->erase(connection.place);  // the caller still holds it
        connection.list = nullptr;
    }
    /// A connection without a response is reset (no TIME_WAIT); others may still receive what was sent.
    void cut_off(Connection& connection) {
        error_code error;
        const bool was_told = connection.list != &strangers_ || connection.leaves;
        if (!was_told) ignore(connection.socket.set_option(asio::socket_base::linger(true, 0), error));
        drop(connection);
    }
    void cut_off_oldest(Connected& list) {
        if (list.empty()) return;
        const ConnectionPointer oldest = std::move(list.front());
        cut_off(*oldest);
    }
    /// Moves it to the end of the list.
    static void move(Connection& connection, Connected& list) {
        list.splice(list.end(), *connection.list, connection.place);
        connection.list = &list;
    }

    void wait(const ConnectionPointer& connection) {
        connection->socket.async_wait(tcp::socket::wait_read, [this, connection](error_code error) {
            if (connection->list == nullptr) return;
            if (error) return drop(*connection);
            read(connection);
        });
    }

    /// Reads the available bytes without blocking.
    void read(const ConnectionPointer& connection) {
        error_code error;
        const std::size_t room = connection->leaves ? scratch_.size() : kLongestHead - connection->bytes.size();
        const std::size_t count = connection->socket.read_some(asio::buffer(scratch_.data(), room), error);
        if (error == asio::error::would_block || error == asio::error::interrupted) return wait(connection);
        if (error) return drop(*connection);
        if (!connection->leaves) {
            if (connection->bytes.empty()) connection->until = std::min(connection->until, Clock::now() + kHeadTime);
            connection->bytes.append(scratch_.data(), count);
            return understand(connection);
        }
        connection->drained += count;
        if (connection->drained > kMaxDrained) return drop(*connection);
        wait(connection);
    }

    void understand(const ConnectionPointer& connection) {
        if (!connection->reader) connection->reader.emplace();
        const HeadReader::State state = connection->reader->read(connection->bytes);
        if (state == HeadReader::State::more) return wait(connection);
        if (state == HeadReader::State::refused) return refuse(connection, answers_.refusal(connection->reader->status()));
        const RequestHead head = connection->reader->head();
        connection->reader.reset();
        if (const std::optional<std::string> answer = answers_.at_the_door(head)) return refuse(connection, *answer);
        if (std::ssize(busy_) >= kMaxAtOnce) return refuse(connection, answers_.refusal(503));
        move(*connection, busy_);
        if (is_handed_over(connection, head)) return;
        move(*connection, strangers_);
        refuse(connection, answers_.refusal(503));
    }

    /// False: there is no thread or no memory for its response.
    bool is_handed_over(const ConnectionPointer& connection, const RequestHead& head) {
        try {
            return workers_.post([this, connection, head] { answer(connection, head); });
        } catch (const std::bad_alloc&) {
            return false;
        }
    }

    /// Sends a whole response and closes: it fits into the send buffer of the socket.
    void refuse(const ConnectionPointer& connection, const std::string& answer) {
        error_code error;
        if (connection->socket.write_some(asio::buffer(answer), error) < answer.size()) return drop(*connection);
        leave(connection);
    }

    /// Shuts down sending and lets the client read the response: closing while the client still sends would discard the response.
    void leave(const ConnectionPointer& connection) {
        error_code error;
        ignore(connection->socket.shutdown(tcp::socket::shutdown_send, error));
        connection->leaves = true;
        connection->bytes = {};
        connection->reader.reset();
        connection->until = Clock::now() + kLeavingTime;
        move(*connection, strangers_);
        wait(connection);
    }

    /// Runs on a worker thread.
    void answer(const ConnectionPointer& connection, const RequestHead& head) {
        bool goes_on = false;
        try {
            goes_on = head.has_body ? is_answered_with_body(*connection, head) : answers_.answer(head, {}, peer_of(*connection));
        } catch (const std::exception&) {  // to this connection only
        }
        const auto then = [this, goes_on](const ConnectionPointer& of) { answered(of, goes_on); };
        asio::post(io_, AfterResponse<decltype(then)>{connection, then});
    }

    static Peer peer_of(Connection& connection) { return Peer(connection.socket.native_handle()); }

    /// True: the connection may be reused.
    bool is_answered_with_body(Connection& connection, const RequestHead& head) {
        const Counted counted(bodies_);
        if (counted.before >= kMaxBodies) {
            (void)peer_of(connection).send(answers_.refusal(503));
            return false;
        }
        const std::optional<std::string> body = body_of(connection, head.length.value_or(0));
        return body && answers_.answer(head, *body, peer_of(connection));
    }

    /// nullopt: it has not come whole within kBodyTime.
    static std::optional<std::string> body_of(Connection& connection, std::size_t length) {
        std::string body = connection.bytes.substr(0, length);
        connection.bytes.erase(0, body.size());
        const Clock::time_point until = Clock::now() + kBodyTime;
        for (std::size_t there = body.size(); there < length;) {
            const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now());
            body.resize(length);
            const std::ptrdiff_t count =
                left.count() > 0 ? peer_of(connection).receive(body.data() + there, length - there, static_cast<int>(left.count())) : -1;
            if (count <= 0) return std::nullopt;
            there += static_cast<std::size_t>(count);
        }
        return body;
    }

    void answered(const ConnectionPointer& connection, bool goes_on) {
        if (!goes_on) return leave(connection);
        if (std::ssize(idle_) >= kMaxIdle) cut_off_oldest(idle_);
        move(*connection, idle_);
        connection->until = Clock::now() + (connection->bytes.empty() ? kIdleTime : kHeadTime);
        if (connection->bytes.empty()) return wait(connection);
        understand(connection);
    }

    const Answers answers_;
    asio::io_context io_{1};
    tcp::acceptor acceptor_{io_};
    asio::steady_timer timer_{io_};
    bool accepting_ = false, ticking_ = false;
    std::atomic<bool> ended_ = false;
    std::atomic<int> bodies_ = 0;        ///< requests with a body in progress
    Connected strangers_, idle_, busy_;  ///< in order of arrival
    std::array<char, kLongestHead> scratch_{};
    Workers workers_{kMaxAtOnce};  ///< the last member: its threads end before the others
};

Network::Network(int port, bool or_any, Answers answers) : connections_(std::make_unique<Connections>(port, or_any, std::move(answers))) {}
Network::~Network() = default;
int Network::port() const { return connections_->port(); }
void Network::run() { connections_->run(); }
void Network::stop() { connections_->stop(); }

}  // namespace isoatlas
