#include "remote/http_client.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <curl/curl.h>

#include "isoatlas/error.h"
#include "remote/transfer.h"

namespace isoatlas {
namespace {

constexpr int kWaitMilliseconds = 200;  ///< between two looks at `cancelled`
constexpr double kFirstPause = 0.15, kLongestPause = 10;

void start_curl() {
    static const CURLcode started = curl_global_init(CURL_GLOBAL_DEFAULT);
    if (started != CURLE_OK)
        throw Error(ErrorKind::resource, {.what = "the network library does not start", .next = "use a file of this machine"});
}

}  // namespace

/// Open connections, used by one thread at a time.
class HttpClient::Connections {
public:
    explicit Connections(const RemoteOptions& options) : options_(options), multi_(curl_multi_init()) {
        curl_multi_setopt(multi_, CURLMOPT_MAX_HOST_CONNECTIONS, static_cast<long>(std::max(1, options.connections)));
        curl_multi_setopt(multi_, CURLMOPT_PIPELINING, CURLPIPE_MULTIPLEX);
    }
    ~Connections() { curl_multi_cleanup(multi_); }
    Connections(const Connections&) = delete;
    Connections& operator=(const Connections&) = delete;

    /// Runs all transfers to their end.
    void run(std::span<const std::unique_ptr<HttpTransfer>> transfers) {
        const Added added(multi_, transfers);
        for (int running = 1; running > 0;) {
            stop_if_cancelled();
            curl_multi_perform(multi_, &running);
            collect();
            if (running > 0) curl_multi_poll(multi_, nullptr, 0, kWaitMilliseconds, nullptr);
        }
        collect();
    }

    void pause(double seconds) {
        for (double left = seconds; left > 0; left -= kWaitMilliseconds / 1000.0) {
            stop_if_cancelled();
            curl_multi_poll(multi_, nullptr, 0, std::min(kWaitMilliseconds, static_cast<int>(std::ceil(left * 1000))), nullptr);
        }
    }

private:
    struct Added {
        Added(CURLM* multi, std::span<const std::unique_ptr<HttpTransfer>> all) : multi_(multi), transfers_(all) {
            for (const auto& transfer : transfers_) curl_multi_add_handle(multi_, transfer->handle());
        }
        ~Added() {
            for (const auto& transfer : transfers_) curl_multi_remove_handle(multi_, transfer->handle());
        }
        Added(const Added&) = delete;
        Added& operator=(const Added&) = delete;

    private:
        CURLM* multi_;
        std::span<const std::unique_ptr<HttpTransfer>> transfers_;
    };

    void collect() {
        int left = 0;
        while (const CURLMsg* message = curl_multi_info_read(multi_, &left)) {
            char* self = nullptr;
            curl_easy_getinfo(message->easy_handle, CURLINFO_PRIVATE, &self);
            reinterpret_cast<HttpTransfer*>(self)->finish(message->data.result);
        }
    }

    void stop_if_cancelled() const {
        if (options_.cancelled && options_.cancelled())
            throw Error(ErrorKind::cancelled, {.what = "reading from the network was cancelled"});
    }

    const RemoteOptions& options_;
    CURLM* multi_;
};

/// Connections out of the pool, and back into it.
struct HttpClient::Lease {
    explicit Lease(HttpClient& client) : client_(client), connections(client.take()) {}
    ~Lease() { client_.give_back(std::move(connections)); }
    Lease(const Lease&) = delete;
    Lease& operator=(const Lease&) = delete;

private:
    HttpClient& client_;

public:
    std::unique_ptr<Connections> connections;
};

HttpClient::HttpClient(const RemoteOptions& options) : options_(options) {}
HttpClient::~HttpClient() = default;

std::unique_ptr<HttpClient::Connections> HttpClient::take() {
    const std::scoped_lock lock(mutex_);
    if (idle_.empty()) return std::make_unique<Connections>(options_);
    std::unique_ptr<Connections> connections = std::move(idle_.back());
    idle_.pop_back();
    return connections;
}

void HttpClient::give_back(std::unique_ptr<Connections> connections) {
    const std::scoped_lock lock(mutex_);
    idle_.push_back(std::move(connections));
}

RemoteTraffic HttpClient::traffic() const {
    const std::scoped_lock lock(mutex_);
    return traffic_;
}

std::vector<HttpAnswer> HttpClient::get(const Address& address, std::span<const RangeSet> ranges, std::int64_t max_whole) {
    if (ranges.empty()) return {};
    start_curl();  // not before it is needed: a program that may read addresses starts as fast as before
    const Lease lease(*this);
    std::vector<HttpAnswer> answers(ranges.size());
    std::vector<std::size_t> open(ranges.size());
    for (std::size_t i = 0; i < open.size(); ++i) open[i] = i;
    double pause = kFirstPause;
    for (int attempt = 1; !open.empty(); ++attempt) {
        std::vector<std::unique_ptr<HttpTransfer>> transfers;
        for (const std::size_t i : open) transfers.push_back(std::make_unique<HttpTransfer>(address, ranges[i], max_whole, options_));
        lease.connections->run(transfers);
        std::vector<std::size_t> again;
        std::int64_t bytes = 0;
        double wait = pause;
        for (std::size_t k = 0; k < open.size(); ++k) {
            bytes += transfers[k]->received();
            wait = std::max(wait, std::min(transfers[k]->retry_after(), kLongestPause));
            if (attempt < options_.attempts && transfers[k]->is_worth_repeating()) again.push_back(open[k]);
            answers[open[k]] = std::move(transfers[k]->answer());
        }
        {
            const std::scoped_lock lock(mutex_);
            const auto sent = static_cast<std::int64_t>(open.size()), at_once = std::int64_t{std::max(1, options_.connections)};
            traffic_.requests += sent;
            traffic_.round_trips += (sent + at_once - 1) / at_once;
            traffic_.bytes += bytes;
            traffic_.repeated += static_cast<std::int64_t>(again.size());
        }
        open = std::move(again);
        if (!open.empty()) lease.connections->pause(wait);
        pause = std::min(2 * pause, kLongestPause);
    }
    return answers;
}

}  // namespace isoatlas
