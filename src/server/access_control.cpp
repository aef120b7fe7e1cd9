#include "server/access_control.h"

#include <algorithm>

#include "isoatlas/error.h"
#include "server/answers.h"
#include "server/response.h"
#include "server/secret.h"

namespace isoatlas {
namespace {

constexpr std::string_view kHtml = "text/html; charset=utf-8", kOnce = "/open?once=", kEnter = "/enter", kChange = "/api/name?";
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
    return html("<script>" + first + "location.replace(\"/\"+location.hash)</script><noscript>The viewer needs JavaScript.</noscript>");
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

ErrorKind kind_of(int status) { return status == 503 ? ErrorKind::resource : ErrorKind::usage; }

ErrorText details_of(int status) {
    switch (status) {
        case 403:
            return {.what = "the token is missing or wrong",
                    .next = "open the address that the server has given",
                    .reason = Reason::token_wrong};
        case 405: return {.what = "method not allowed", .expected = "GET or HEAD; PUT of /api/name"};
        case 413: return {.what = "a request must not have a body", .expected = "a request without one"};
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

std::string AccessControl::address_for_one_use() {
    const std::lock_guard lock(mutex_);
    if (codes_.size() == kMaxCodes) codes_.pop_front();
    codes_.push_back({random_secret(), now_() + kCodeTime});
    return address().append(kOnce).append(codes_.back().secret);
}

bool AccessControl::use(std::string_view code) {
    const std::lock_guard lock(mutex_);
    const Clock::time_point now = now_();
    std::erase_if(codes_, [now](const Code& one) { return one.until <= now; });
    return std::erase_if(codes_, [code](const Code& one) { return is_secret(code, one.secret); }) > 0;
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
    if (!use(code)) return refused_page();
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
    if (!is_ours(head)) return refusal(421);  // DNS rebinding
    const bool is_change = head.method == "PUT" && std::string_view(head.target).starts_with(kChange);
    if (head.method != "GET" && head.method != "HEAD" && !is_change) return refusal(405);
    if (head.has_body) return refusal(413);
    if (!head.origin.empty() && head.origin != "http://" + head.host) return refusal(403);
    const std::string_view target = head.target, path = target.substr(0, target.find('?'));
    if (head.method == "GET" && target.starts_with(kOnce)) return open(target.substr(kOnce.size()));
    if (path == kEnter) return last_answer({.type = kHtml}, html_that_goes_on({}));
    if (may_ask(head, path == "/")) return std::nullopt;
    if (path != "/") return refusal(403);
    // A link on another site: the browser withholds the cookie, but sends it with the redirect from our own page.
    const bool led_here = head.fetch_site == "cross-site" || head.fetch_site == "same-site";
    if (led_here) return last_answer({.status = 303, .fields = {{"Location", std::string(kEnter)}}}, {});
    return refused_page();
}

}  // namespace isoatlas
