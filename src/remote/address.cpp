#include "remote/address.h"

#include <memory>

#include <curl/curl.h>

#include "formats/common/text.h"
#include "isoatlas/error.h"

namespace isoatlas {
namespace {

using Url = std::unique_ptr<CURLU, decltype(&curl_url_cleanup)>;

/// "" where there is no such part.
std::string part_of(CURLU* url, CURLUPart part, unsigned flags = 0) {
    char* text = nullptr;
    if (curl_url_get(url, part, &text, flags) != CURLUE_OK || text == nullptr) return {};
    std::string copy(text);
    curl_free(text);
    return copy;
}

Address address_of(CURLU* url) {
    curl_url_set(url, CURLUPART_FRAGMENT, nullptr, 0);
    return {part_of(url, CURLUPART_URL), part_of(url, CURLUPART_SCHEME), lower(part_of(url, CURLUPART_HOST)),
            part_of(url, CURLUPART_PORT, CURLU_DEFAULT_PORT)};
}

std::string without_query(const std::string& url) { return url.substr(0, url.find_first_of("?#")); }

}  // namespace

Address parse_address(const std::string& text) {
    const Url url(curl_url(), curl_url_cleanup);
    const bool is_http = text.starts_with("http://") || text.starts_with("https://");
    const CURLUcode code = is_http ? curl_url_set(url.get(), CURLUPART_URL, text.c_str(), CURLU_URLENCODE) : CURLUE_BAD_SCHEME;
    const bool has_secret = !part_of(url.get(), CURLUPART_USER).empty() || !part_of(url.get(), CURLUPART_PASSWORD).empty();
    if (has_secret) {
        throw Error(ErrorKind::usage, {.what = "an address with a user name or password in it is not opened: it would be shown and stored",
                                       .next = "leave them out; give a token beside the address",
                                       .reason = Reason::address_with_password});
    }
    if (code == CURLUE_OK) return address_of(url.get());
    throw Error(ErrorKind::usage, {.file = without_query(text),
                                   .what = std::string("is not an address: ") + curl_url_strerror(code),
                                   .expected = "https://HOST/PATH",
                                   .next = "check how it is written"});
}

Address redirected(const Address& from, const std::string& location) {
    const Url url(curl_url(), curl_url_cleanup);
    CURLUcode code = curl_url_set(url.get(), CURLUPART_URL, from.url.c_str(), 0);
    if (code == CURLUE_OK) code = curl_url_set(url.get(), CURLUPART_URL, location.c_str(), CURLU_URLENCODE);
    const Address to = code == CURLUE_OK ? address_of(url.get()) : Address{};
    if (to.scheme == "http" || to.scheme == "https") return to;
    throw Error(ErrorKind::input, {.file = shown(from),
                                   .what = "the server redirects to \"" + without_query(location) + "\", which is not an address",
                                   .next = "check the address, or ask who runs the server"});
}

bool stays_on_host(const Address& from, const Address& to) {
    if (from.host != to.host) return false;
    const bool is_upgrade = from.scheme == "http" && to.scheme == "https" && from.port == "80" && to.port == "443";
    return is_upgrade || (from.scheme == to.scheme && from.port == to.port);
}

bool keeps_secrets(const Address& address) {
    return address.scheme == "https" || address.host == "localhost" || address.host == "127.0.0.1" || address.host == "[::1]";
}

std::string shown(const Address& address) { return without_query(address.url); }

}  // namespace isoatlas
