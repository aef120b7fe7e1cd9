#include "server/request_head.h"

#include <limits>

#include <boost/asio/buffer.hpp>
#include <boost/beast/http/basic_parser.hpp>

namespace isoatlas {

namespace http = boost::beast::http;
using boost::beast::string_view;
using boost::system::error_code;

/// The grammar is Boost.Beast's; only the fields in use are stored.
class HeadReader::Parser final : public http::basic_parser<true> {
public:
    Parser() {
        header_limit(kLongestHead);
        body_limit(std::numeric_limits<std::uint64_t>::max());  // its caller bounds what it reads of a body
    }
    RequestHead head;

private:
    /// Fields that must not be repeated: which one is valid would be ambiguous.
    static void take_once(std::string& value, string_view text, error_code& error) {
        if (!value.empty()) error = http::error::bad_field;
        value.assign(text.data(), text.size());
    }

    void on_request_impl(http::verb, string_view method, string_view target, int version, error_code&) override {
        head.method.assign(method.data(), method.size());
        head.target.assign(target.data(), target.size());
        head.is_old = version < 11;
    }
    void on_field_impl(http::field name, string_view text, string_view value, error_code& error) override {
        if (++fields_ > kMaxFields) {
            error = http::error::header_limit;
            return;
        }
        if (name == http::field::host) return take_once(head.host, value, error);
        if (name == http::field::authorization) return take_once(head.authorization, value, error);
        if (name == http::field::cookie) return take_once(head.cookie, value, error);
        if (name == http::field::origin) return take_once(head.origin, value, error);
        if (name == http::field::range) return take_once(head.range, value, error);
        if (name == http::field::accept_encoding) head.accept_encoding.assign(value.data(), value.size());
        if (boost::beast::iequals(text, "X-Client")) return take_once(head.client, value, error);
        if (boost::beast::iequals(text, "X-Frame-Key")) return take_once(head.frame_key, value, error);
        if (boost::beast::iequals(text, "Sec-Fetch-Site")) return take_once(head.fetch_site, value, error);
    }
    void on_header_impl(error_code&) override {}

    // For responses and bodies: never called.
    void on_response_impl(int, string_view, int, error_code&) override {}
    void on_body_init_impl(boost::optional<std::uint64_t> const&, error_code&) override {}
    std::size_t on_body_impl(string_view, error_code&) override { return 0; }
    void on_chunk_header_impl(std::uint64_t, string_view, error_code&) override {}
    std::size_t on_chunk_body_impl(std::uint64_t, string_view, error_code&) override { return 0; }
    void on_finish_impl(error_code&) override {}

    int fields_ = 0;
};

HeadReader::HeadReader() : parser_(std::make_unique<Parser>()) {}
HeadReader::~HeadReader() = default;

HeadReader::State HeadReader::read(std::string& bytes) {
    error_code error;
    std::size_t used = 0;
    while (!parser_->is_header_done() && used < bytes.size()) {
        const std::size_t count = parser_->put(boost::asio::const_buffer(bytes.data() + used, bytes.size() - used), error);
        used += count;
        if (error || count == 0) break;
    }
    bytes.erase(0, used);
    taken_ += used;  // the limit of the parser applies to each call only
    if (error && error != http::error::need_more) {
        status_ = error == http::error::header_limit ? 431 : error == http::error::bad_version ? 505 : 400;
        return State::refused;
    }
    const bool is_whole = parser_->is_header_done();
    if (is_whole ? taken_ > kLongestHead : taken_ + bytes.size() >= kLongestHead) {
        status_ = 431;
        return State::refused;
    }
    if (!is_whole) return State::more;
    parser_->head.keep_alive = parser_->keep_alive();
    parser_->head.has_body = !parser_->is_done();
    if (const auto length = parser_->content_length()) parser_->head.length = *length;
    return State::whole;
}

const RequestHead& HeadReader::head() const { return parser_->head; }
int HeadReader::status() const { return status_; }

}  // namespace isoatlas
