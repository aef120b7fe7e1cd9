#include "remote/transfer.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/common/text.h"
#include "isoatlas/version.h"

namespace isoatlas {
namespace {

constexpr long kConnectMilliseconds = 10000;
constexpr std::int64_t kMostBytes = std::int64_t{1} << 62;
constexpr std::int64_t kPartHeader = 1 << 10;      ///< what a part of several may take beside its bytes
constexpr std::int64_t kMostErrorBody = 64 << 10;  ///< of an error page, which nobody reads

/// "bytes 0-99/1000" or "bytes 0-99/*"; nothing changes where it is something else.
void parse_content_range(std::string_view text, FileRange& range, std::int64_t& size) {
    if (!text.starts_with("bytes ")) return;
    text.remove_prefix(6);
    const std::size_t dash = text.find('-'), slash = text.find('/');
    if (dash == std::string_view::npos || slash == std::string_view::npos || dash > slash) return;
    const auto first = parse_integer(text.substr(0, dash)), last = parse_integer(text.substr(dash + 1, slash - dash - 1));
    if (first && last && 0 <= *first && *first <= *last && *last < kMostBytes) range = {*first, *last + 1};
    if (const auto total = parse_integer(text.substr(slash + 1)); total && *total >= 0) size = *total;
}

bool is_certificate_problem(CURLcode code) {
    return code == CURLE_PEER_FAILED_VERIFICATION || code == CURLE_SSL_CERTPROBLEM || code == CURLE_SSL_CACERT_BADFILE ||
           code == CURLE_SSL_ISSUER_ERROR || code == CURLE_SSL_INVALIDCERTSTATUS;
}

std::string boundary_of(const std::string& content_type) {
    const std::size_t found = lower(content_type).find("boundary=");
    if (found == std::string::npos) return {};
    std::string boundary = content_type.substr(found + 9);
    boundary = boundary.substr(0, boundary.find(';'));
    if (boundary.size() > 1 && boundary.front() == '"' && boundary.back() == '"') boundary = boundary.substr(1, boundary.size() - 2);
    return boundary;
}

/// The parts of a body of several (RFC 9110, 14.6: multipart/byteranges); those until the first that is not whole.
std::vector<AnswerPart> parts_of(std::string_view body, const std::string& boundary) {
    std::vector<AnswerPart> parts;
    const std::string mark = "--" + boundary;
    for (std::size_t at = body.find(mark); !boundary.empty() && at != std::string_view::npos; at = body.find(mark, at)) {
        const std::size_t end = body.find("\r\n\r\n", at);
        if (end == std::string_view::npos) break;
        AnswerPart part{.range = {}, .place = end + 4};
        std::int64_t total = -1;
        const std::string head = lower(body.substr(at, end - at));
        const std::size_t field = head.find("content-range:");
        if (field == std::string::npos) break;
        const std::size_t value = std::min(head.find_first_not_of(' ', field + 14), head.size());
        parse_content_range(std::string_view(head).substr(value, head.find("\r\n", value) - value), part.range, total);
        if (part.range.bytes() <= 0 || part.range.bytes() > std::ssize(body.substr(part.place))) break;
        parts.push_back(part);
        at = part.place + static_cast<std::size_t>(part.range.bytes());
    }
    return parts;
}

bool is_covered(const FileRange& range, std::vector<AnswerPart> parts) {
    std::ranges::sort(parts, {}, [](const AnswerPart& part) { return part.range.begin; });
    std::int64_t position = range.begin;
    for (const AnswerPart& part : parts) {
        if (part.range.begin <= position) position = std::max(position, part.range.end);
    }
    return position >= range.end;
}

}  // namespace

HttpTransfer::HttpTransfer(const Address& address, RangeSet ranges, std::int64_t max_whole, const RemoteOptions& options)
    : handle_(curl_easy_init()), ranges_(std::move(ranges)), max_whole_(max_whole) {
    const auto set = [this](CURLoption option, auto value) { curl_easy_setopt(handle_, option, value); };
    std::string bytes;
    for (const FileRange& range : ranges_)
        bytes += (bytes.empty() ? "" : ",") + std::to_string(range.begin) + "-" + std::to_string(range.end - 1);
    set(CURLOPT_URL, address.url.c_str());
    set(CURLOPT_RANGE, bytes.c_str());
    set(CURLOPT_PROTOCOLS_STR, "http,https");
    set(CURLOPT_HTTP_VERSION, static_cast<long>(CURL_HTTP_VERSION_2TLS));
    set(CURLOPT_NOSIGNAL, 1L);
    set(CURLOPT_FOLLOWLOCATION, 0L);
    set(CURLOPT_CONNECTTIMEOUT_MS, std::min(kConnectMilliseconds, static_cast<long>(options.timeout * 1000)));
    set(CURLOPT_LOW_SPEED_LIMIT, 1L);
    set(CURLOPT_LOW_SPEED_TIME, std::max(1L, static_cast<long>(options.timeout)));
    set(CURLOPT_USERAGENT, "isoatlas/" ISOATLAS_VERSION);
    set(CURLOPT_ERRORBUFFER, static_cast<char*>(message_));
    set(CURLOPT_HEADERFUNCTION, &HttpTransfer::on_header);
    set(CURLOPT_HEADERDATA, static_cast<void*>(this));
    set(CURLOPT_WRITEFUNCTION, &HttpTransfer::on_body);
    set(CURLOPT_WRITEDATA, static_cast<void*>(this));
    set(CURLOPT_PRIVATE, static_cast<void*>(this));
    if (!options.certificates.empty()) set(CURLOPT_CAINFO, options.certificates.c_str());
    if (options.token.empty() || !keeps_secrets(address)) return;
    headers_ = curl_slist_append(headers_, ("Authorization: Bearer " + options.token).c_str());
    set(CURLOPT_HTTPHEADER, headers_);
}

HttpTransfer::~HttpTransfer() {
    curl_easy_cleanup(handle_);
    curl_slist_free_all(headers_);
}

std::size_t HttpTransfer::on_header(char* text, std::size_t size, std::size_t count, void* self) {
    static_cast<HttpTransfer*>(self)->take_header(std::string(text, size * count));
    return size * count;
}

std::size_t HttpTransfer::on_body(char* bytes, std::size_t size, std::size_t count, void* self) {
    return static_cast<HttpTransfer*>(self)->take_body(bytes, size * count) ? size * count : 0;
}

void HttpTransfer::take_header(std::string line) {
    while (!line.empty() && (line.back() == '\n' || line.back() == '\r' || line.back() == ' ')) line.pop_back();
    if (line.starts_with("HTTP/")) {  // of the next answer, after one of 1xx
        answer_ = {};
        content_range_ = {};
        content_type_.clear();
        content_length_ = -1, retry_after_ = 0;
        return;
    }
    const std::size_t colon = line.find(':');
    if (colon == std::string::npos) return;
    const std::string name = lower(line.substr(0, colon));
    const std::string value = line.substr(std::min(line.find_first_not_of(" \t", colon + 1), line.size()));
    if (name == "content-range") parse_content_range(value, content_range_, answer_.total);
    if (name == "content-type") content_type_ = value;
    if (name == "content-length") content_length_ = parse_integer(value).value_or(-1);
    if (name == "etag") answer_.etag = value;
    if (name == "last-modified") answer_.last_modified = value;
    if (name == "location") answer_.location = value;
    if (name == "retry-after") retry_after_ = static_cast<double>(std::max<std::int64_t>(parse_integer(value).value_or(0), 0));
}

std::int64_t HttpTransfer::most_bytes(long status) const {
    if (status == 200) return max_whole_;
    if (status != 206) return kMostErrorBody;
    std::int64_t bytes = 0;
    for (const FileRange& range : ranges_) bytes += range.bytes() + (ranges_.size() > 1 ? kPartHeader : 0);
    return bytes;
}

bool HttpTransfer::take_body(const char* bytes, std::size_t count) {
    long status = 0;
    curl_easy_getinfo(handle_, CURLINFO_RESPONSE_CODE, &status);
    received_ += static_cast<std::int64_t>(count);
    if (received_ > most_bytes(status) || (status == 200 && content_length_ > max_whole_)) {
        is_refused_ = true;
        return false;
    }
    const auto* begin = reinterpret_cast<const std::byte*>(bytes);
    if (status == 206 || status == 200) answer_.body.insert(answer_.body.end(), begin, begin + count);
    return true;
}

void HttpTransfer::finish(CURLcode code) {
    code_ = code;
    long status = 0;
    curl_easy_getinfo(handle_, CURLINFO_RESPONSE_CODE, &status);
    answer_.status = static_cast<int>(status);
    if (is_refused_) {
        answer_.body.clear();
        if (answer_.status == 206) answer_.problem = "more bytes than were asked for";
        if (answer_.status == 200) answer_.total = content_length_;
        return;
    }
    if (code != CURLE_OK) {
        answer_.problem = message_[0] != 0 ? message_ : curl_easy_strerror(code);
        answer_.is_certificate = is_certificate_problem(code);
        answer_.body.clear();
        return;
    }
    if (answer_.status == 200) answer_.total = std::ssize(answer_.body);
    if (answer_.status == 206) judge_ranges();
    if (!answer_.problem.empty()) answer_.body.clear(), answer_.parts.clear();
}

void HttpTransfer::judge_ranges() {
    const bool is_multipart = lower(content_type_).starts_with("multipart/byteranges");
    if (is_multipart) {
        const std::string_view body(reinterpret_cast<const char*>(answer_.body.data()), answer_.body.size());
        answer_.parts = parts_of(body, boundary_of(content_type_));
    } else if (content_range_.bytes() > 0 && std::ssize(answer_.body) == content_range_.bytes()) {
        answer_.parts = {{content_range_, 0}};
    } else if (content_range_.bytes() > 0) {
        answer_.problem = std::to_string(answer_.body.size()) + " bytes instead of " + std::to_string(content_range_.bytes());
        return;
    }
    for (FileRange range : ranges_) {
        if (answer_.total >= 0) range.end = std::min(range.end, answer_.total);
        if (is_covered(range, answer_.parts)) continue;
        answer_.problem = "another range than was asked for";
        answer_.lacks_ranges = ranges_.size() > 1;
    }
}

bool HttpTransfer::is_worth_repeating() const {
    if (answer_.is_certificate || answer_.lacks_ranges || code_ == CURLE_UNSUPPORTED_PROTOCOL || code_ == CURLE_URL_MALFORMAT) return false;
    return !answer_.problem.empty() || answer_.status == 0 || answer_.status == 408 || answer_.status == 429 || answer_.status >= 500;
}

}  // namespace isoatlas
