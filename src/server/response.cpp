#include "server/response.h"

#include <array>
#include <charconv>

namespace isoatlas {
namespace {

constexpr std::pair<const char*, const char*> kFields[] = {
    {"X-Content-Type-Options", "nosniff"}, {"Referrer-Policy", "no-referrer"}, {"Cache-Control", "no-store"}};
constexpr std::string_view kPolicy =
    "default-src 'none'; script-src 'unsafe-inline' 'wasm-unsafe-eval'; style-src 'unsafe-inline'; connect-src 'self'; "
    "img-src data: blob:; base-uri 'none'; form-action 'none'";

std::string_view reason_of(int status) {
    switch (status) {
        case 200: return "OK";
        case 206: return "Partial Content";
        case 303: return "See Other";
        case 400: return "Bad Request";
        case 401: return "Unauthorized";
        case 403: return "Forbidden";
        case 404: return "Not Found";
        case 405: return "Method Not Allowed";
        case 409: return "Conflict";
        case 413: return "Content Too Large";
        case 416: return "Range Not Satisfiable";
        case 421: return "Misdirected Request";
        case 431: return "Request Header Fields Too Large";
        case 503: return "Service Unavailable";
        case 505: return "HTTP Version Not Supported";
        default: return "Internal Server Error";
    }
}

void add(std::string& text, std::string_view name, std::string_view value) { ((((text += name) += ": ") += value) += "\r\n"); }

}  // namespace

std::string text_of(const ResponseHead& head) {
    std::string text = "HTTP/1.1 " + std::to_string(head.status) + " ";
    (text += reason_of(head.status)) += "\r\n";
    for (const auto& [name, value] : kFields) add(text, name, value);
    add(text, "Accept-Ranges", head.has_ranges ? "bytes" : "none");
    add(text, "Content-Security-Policy", std::string(kPolicy) + (head.may_be_framed ? "" : "; frame-ancestors 'none'"));
    for (const auto& [name, value] : head.fields) add(text, name, value);
    if (!head.type.empty()) add(text, "Content-Type", head.type);
    if (head.length) {
        add(text, "Content-Length", std::to_string(*head.length));
    } else if (!head.is_old) {
        add(text, "Transfer-Encoding", "chunked");
    }
    add(text, "Connection", head.keep_alive ? "keep-alive" : "close");
    return text + "\r\n";
}

std::string last_answer(ResponseHead head, std::string_view body) {
    head.length = body.size();
    head.keep_alive = false;
    return text_of(head).append(body);
}

std::string chunk(std::string_view bytes) {
    std::array<char, 16> digits{};
    char* end = std::to_chars(digits.data(), digits.data() + digits.size(), bytes.size(), 16).ptr;
    return std::string(digits.data(), static_cast<std::size_t>(end - digits.data())).append("\r\n").append(bytes).append("\r\n");
}

}  // namespace isoatlas
