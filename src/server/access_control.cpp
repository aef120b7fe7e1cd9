#include "server/access_control.h"

#include <algorithm>

#include "isoatlas/error.h"
#include "server/answers.h"
#include "server/response.h"
#include "server/secret.h"
#include "server/shared_scene.h"
#include "server/target.h"

namespace isoatlas {
namespace {

constexpr std::string_view kHtml = "text/html; charset=utf-8", kOnce = "/open?once=", kFrame = "/frame?once=", kEnter = "/enter";
constexpr std::string_view kChange = "/api/name?", kSetScene = "/api/scene", kSetSceneAfter = "/api/scene?", kAddress = "/api/address";
constexpr const char* kThirtyDays = "; Max-Age=2592000";

std::string_view bearer_of(const RequestHead& head) {
    constexpr std::string_view scheme = "Bearer ";
    const std::string_view value = head.authorization;
    return value.starts_with(scheme) ? value.substr(scheme.size()) : std::string_view();
}

std::string html(std::string_view content) {
    return std::string("<!doctype html><html lang=en><meta charset=utf-8><title>isoatlas</title>").append(content).append("</html>\n");
}

/// Redirects and keeps the fragment, which browsers never send. The request then comes from our own page, so that the browser sends its
/// SameSite cookie.
std::string html_that_goes_on(const std::string& first) {
    return html("<script>" + first + "location.replace(\"./\"+location.hash)</script><noscript>The viewer needs JavaScript.</noscript>");
}

std::string refused_page() {
    return last_answer(
        {.status = 403, .type = kHtml},
        html("<p role=alert>This address needs the token of its viewer: each address that the viewer prints works once, within ten "
             "minutes, in one browser. Press Enter where it was started, and open the address that it prints.</p>"));
}

AccessControl::Secrets complete(AccessControl::Secrets secrets) {
    for (std::string* secret : {&secrets.cookie, &secrets.key}) {
        if (secret->empty()) *secret = random_secret();
    }
    return secrets;
}

/// Not a new address, whose cookie would outlive the frame, however it is written.
bool may_ask_in_frame(std::string_view path) {
    return path.starts_with("/api/") && path.find('%') == std::string_view::npos && path != kAddress;
}

ErrorKind kind_of(int status) { return status == 503 ? ErrorKind::resource : ErrorKind::usage; }

ErrorText details_of(int status) {
    switch (status) {
        case 403:
            return {.what = "the token is missing or wrong",
                    .next = "open the address that the server has given",
                    .reason = Reason::token_wrong};
        case 405: return {.what = "method not allowed", .expected = "GET or HEAD; PUT of /api/name and of /api/scene"};
        case 413:
            return {.what = "a request must not have such a body",
                    .expected = "none; PUT of /api/scene at most " + std::to_string(kLongestScene) + " bytes, with Content-Length"};
        case 421: return {.what = "wrong Host header", .expected = "127.0.0.1 or localhost, with the port"};
        case 431:
            return {.what = "the request is too long",
                    .expected = "at most " + std::to_string(kLongestHead) + " bytes and " + std::to_string(kMaxFields) + " header fields"};
        case 503: return {.what = "too many requests at a time", .next = "retry later"};
        case 505: return {.what = "this version of HTTP is not supported", .expected = "HTTP/1.1 or HTTP/1.0"};
        default: return {.what = "not an HTTP request"};
    }
}

}  // namespace

AccessControl::AccessControl(int port, Secrets secrets, std::function<Clock::time_point()> now)
    : port_(std::to_string(port)), secrets_(complete(std::move(secrets))), now_(std::move(now)) {}

std::string AccessControl::address() const { return "http://127.0.0.1:" + port_; }

std::string AccessControl::new_address(Codes& codes, std::string_view target) {
    const std::lock_guard lock(mutex_);
    if (codes.size() == kMaxCodes) codes.pop_front();
    codes.push_back({random_secret(), now_() + kCodeTime});
    return address().append(target).append(codes.back().secret);
}

std::string AccessControl::address_for_one_use() { return new_address(codes_, kOnce); }
std::string AccessControl::address_for_one_frame() { return new_address(frame_codes_, kFrame); }

bool AccessControl::is_valid(Codes& codes, std::string_view code) {
    const std::lock_guard lock(mutex_);
    const Clock::time_point now = now_();
    std::erase_if(codes, [now](const Code& one) { return one.until <= now; });
    return std::ranges::any_of(codes, [code](const Code& one) { return is_secret(code, one.secret); });
}

bool AccessControl::use(Codes& codes, std::string_view code) {
    if (!is_valid(codes, code)) return false;
    const std::lock_guard lock(mutex_);
    return std::erase_if(codes, [code](const Code& one) { return is_secret(code, one.secret); }) > 0;
}

std::optional<std::string> AccessControl::open_frame(std::string_view target) {
    if (!target.starts_with(kFrame) || !use(frame_codes_, target.substr(kFrame.size()))) return std::nullopt;
    const std::lock_guard lock(mutex_);
    if (frame_keys_.size() == kMaxFrames) frame_keys_.pop_front();
    return frame_keys_.emplace_back(random_secret());
}

std::string AccessControl::refused_frame() {
    return last_answer({.status = 403, .type = kHtml, .may_be_framed = true},
                       html("<p role=alert>This address has been used or has expired: it shows the navigator once, within ten minutes. "
                            "Run the cell of the notebook again.</p>"));
}

bool AccessControl::has_frame_key(const RequestHead& head) {
    const std::lock_guard lock(mutex_);
    const auto found = std::ranges::find_if(frame_keys_, [&](const std::string& key) { return is_secret(head.frame_key, key); });
    if (found == frame_keys_.end()) return false;
    std::rotate(found, found + 1, frame_keys_.end());
    return true;
}

std::string AccessControl::refusal(int status) {
    return last_answer({.status = status, .type = "application/json"}, error_json(Error(kind_of(status), details_of(status))));
}

bool AccessControl::is_ours(const RequestHead& head) const {
    return head.host == "127.0.0.1:" + port_ || head.host == "localhost:" + port_;
}

bool AccessControl::has_cookie(std::string_view cookies) const {
    const std::string name = "isoatlas-" + port_ + "=";
    while (!cookies.empty()) {
        std::string_view one = cookies.substr(0, cookies.find(';'));
        cookies.remove_prefix(std::min(one.size() + 1, cookies.size()));
        one.remove_prefix(std::min(one.find_first_not_of(' '), one.size()));
        if (one.starts_with(name) && is_secret(one.substr(name.size()), secrets_.cookie)) return true;
    }
    return false;
}

bool AccessControl::may_ask(const RequestHead& head, bool is_page) const {
    const std::string_view bearer = bearer_of(head);
    if (is_secret(bearer, secrets_.token)) return true;
    if (!has_cookie(head.cookie)) return false;
    if (is_page) return true;  // navigation sends the cookie only
    const bool from_ours = head.fetch_site.empty() || head.fetch_site == "same-origin" || head.fetch_site == "none";
    return from_ours && is_secret(bearer, secrets_.key);
}

std::string AccessControl::open(std::string_view code) {
    if (!use(codes_, code)) return refused_page();
    const std::string cookie =
        "isoatlas-" + port_ + "=" + secrets_.cookie + "; Path=/; HttpOnly; SameSite=Strict" + (secrets_.is_kept ? kThirtyDays : "");
    return last_answer({.type = kHtml, .fields = {{"Set-Cookie", cookie}}},
                       html_that_goes_on("localStorage.setItem(\"isoatlas\",\"" + secrets_.key + "\");"));
}

std::optional<std::string> AccessControl::answer(const RequestHead& head) {
    std::optional<std::string> answer = whole_answer(head);
    if (answer && head.method == "HEAD") answer->resize(answer->find("\r\n\r\n") + 4);
    return answer;
}

std::optional<std::string> AccessControl::whole_answer(const RequestHead& head) {
    const VolumeTarget of_volume = volume_target_of(head.target);
    const std::string_view target = of_volume.rest, path = target.substr(0, target.find('?'));
    const bool opens_frame = head.method == "GET" && target.starts_with(kFrame), is_of_frame = has_frame_key(head);
    // Nothing that a browser adds by itself authorises a frame: it may stand below another name, such as that of a proxy.
    const bool is_ambient = !opens_frame && !is_of_frame;
    if (is_ambient && !is_ours(head)) return refusal(421);  // DNS rebinding
    const bool sets_scene = head.method == "PUT" && (target == kSetScene || target.starts_with(kSetSceneAfter));
    const bool is_change = sets_scene || (head.method == "PUT" && target.starts_with(kChange));
    if (head.method != "GET" && head.method != "HEAD" && !is_change) return refusal(405);
    if (head.has_body && !(sets_scene && head.length && *head.length <= kLongestScene)) return refusal(413);
    if (opens_frame) return is_valid(frame_codes_, target.substr(kFrame.size())) ? std::nullopt : std::optional(refused_frame());
    if (is_of_frame) return may_ask_in_frame(path) ? std::nullopt : std::optional(refusal(403));
    if (!head.origin.empty() && head.origin != "http://" + head.host) return refusal(403);
    if (head.method == "GET" && target.starts_with(kOnce)) return open(target.substr(kOnce.size()));
    if (path == kEnter) return last_answer({.type = kHtml}, html_that_goes_on({}));
    if (may_ask(head, path == "/")) return std::nullopt;
    if (path != "/") return refusal(403);
    // A link on another site: the browser withholds the cookie, but sends it with the redirect from our own page.
    const bool led_here = head.fetch_site == "cross-site" || head.fetch_site == "same-site";
    if (led_here) return last_answer({.status = 303, .fields = {{"Location", std::string(of_volume.prefix).append(kEnter)}}}, {});
    return refused_page();
}

}  // namespace isoatlas
