#include "server/response_reader.h"

#include <limits>

#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/string_body.hpp>

namespace isoatlas {

namespace http = boost::beast::http;

struct ResponseReader::Parser {
    http::response_parser<http::string_body> parser;
};

ResponseReader::ResponseReader() : parser_(std::make_unique<Parser>()) {
    parser_->parser.eager(true);
    parser_->parser.body_limit(std::numeric_limits<std::uint64_t>::max());  // a surface may be large
}
ResponseReader::~ResponseReader() = default;

bool ResponseReader::read(std::string_view bytes) {
    rest_.append(bytes);
    std::size_t used = 0;
    boost::system::error_code error;
    while (used < rest_.size() && !is_whole()) {
        const std::size_t count = parser_->parser.put(boost::asio::const_buffer(rest_.data() + used, rest_.size() - used), error);
        used += count;
        if (error || count == 0) break;
    }
    rest_.erase(0, used);
    return !error || error == http::error::need_more;
}

bool ResponseReader::is_whole() const { return parser_->parser.is_done(); }
int ResponseReader::status() const { return parser_->parser.get().result_int(); }
std::string ResponseReader::type() const {
    const auto text = parser_->parser.get()[http::field::content_type];
    return {text.data(), text.size()};
}
std::string& ResponseReader::body() { return parser_->parser.get().body(); }

}  // namespace isoatlas
