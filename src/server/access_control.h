// Authentication and authorisation of requests. A program sends the token. A browser opens a single-use address, /open?once=CODE; it
// receives a cookie and a key, and its pages send both: a cookie alone is sent to every port of this machine, a key alone could be read by
// a script.
#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "server/request_head.h"

namespace isoatlas {

class AccessControl {
public:
    using Clock = std::chrono::steady_clock;

    struct Secrets {
        std::string token;            ///< sent by programs
        std::string cookie{}, key{};  ///< of browsers; empty: random
        bool is_kept = false;         ///< browsers keep the cookie when they end
    };
    /// now: the clock, for tests.
    AccessControl(int port, Secrets secrets, std::function<Clock::time_point()> now = Clock::now);

    /// http://127.0.0.1:PORT, without anything secret.
    [[nodiscard]] std::string address() const;
    /// An address that opens the page once, within kCodeTime. From any thread. At most kMaxCodes are valid at a time: the oldest expires.
    [[nodiscard]] std::string address_for_one_use();
    static constexpr std::chrono::minutes kCodeTime{10};
    static constexpr std::size_t kMaxCodes = 16;

    /// The whole response to an unauthorised request, and to a browser that opens an address; nullopt: the request is authorised. From any
    /// thread; fast.
    [[nodiscard]] std::optional<std::string> answer(const RequestHead& head);
    /// The whole response of a refused request: 400, 403, 405, 413, 421, 431, 503, 505.
    [[nodiscard]] static std::string refusal(int status);

private:
    struct Code {
        std::string secret;
        Clock::time_point until;
    };
    [[nodiscard]] std::optional<std::string> whole_answer(const RequestHead& head);
    [[nodiscard]] bool is_ours(const RequestHead& head) const;
    [[nodiscard]] bool has_cookie(std::string_view cookies) const;
    [[nodiscard]] bool may_ask(const RequestHead& head, bool is_page) const;
    [[nodiscard]] std::string open(std::string_view code);
    [[nodiscard]] bool use(std::string_view code);

    const std::string port_;
    const Secrets secrets_;
    const std::function<Clock::time_point()> now_;
    std::mutex mutex_;
    std::deque<Code> codes_;
};

}  // namespace isoatlas
