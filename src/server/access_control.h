// Authentication and authorisation of requests. A program sends the token. A browser opens a single-use address, /open?once=CODE; it
// receives a cookie and a key, and its pages send both: a cookie alone is sent to every port of this machine, a key alone could be read by
// a script. A page in a frame of another page, /frame?once=CODE, has a key of its own and no cookie (docs/decisions/0053-frames.md).
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
    /// The same for a page in a frame; the codes of the two are kept apart.
    [[nodiscard]] std::string address_for_one_frame();
    static constexpr std::chrono::minutes kCodeTime{10};
    static constexpr std::size_t kMaxCodes = 16;

    /// Uses the code of a target /frame?once=CODE: the key of a new page in a frame; nullopt: it is not valid any more. From any thread. At
    /// most kMaxFrames keys are valid at a time: that which was used longest ago expires.
    [[nodiscard]] std::optional<std::string> open_frame(std::string_view target);
    static constexpr std::size_t kMaxFrames = 64;
    /// The whole response to a frame whose code is not valid.
    [[nodiscard]] static std::string refused_frame();

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
    using Codes = std::deque<Code>;
    [[nodiscard]] std::optional<std::string> whole_answer(const RequestHead& head);
    [[nodiscard]] std::string new_address(Codes& codes, std::string_view target);
    [[nodiscard]] bool is_ours(const RequestHead& head) const;
    [[nodiscard]] bool has_cookie(std::string_view cookies) const;
    [[nodiscard]] bool may_ask(const RequestHead& head, bool is_page) const;
    [[nodiscard]] std::string open(std::string_view code);
    [[nodiscard]] bool use(Codes& codes, std::string_view code);
    [[nodiscard]] bool is_valid(Codes& codes, std::string_view code);
    [[nodiscard]] bool has_frame_key(const RequestHead& head);

    const std::string port_;
    const Secrets secrets_;
    const std::function<Clock::time_point()> now_;
    std::mutex mutex_;
    Codes codes_, frame_codes_;
    std::deque<std::string> frame_keys_;  ///< the one that was used last at the end
};

}  // namespace isoatlas
