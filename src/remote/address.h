// Addresses: http:// and https:// URLs.
#pragma once

#include <string>

namespace isoatlas {

struct Address {
    std::string url;     ///< as it is requested, without a fragment
    std::string scheme;  ///< "http" or "https"
    std::string host;    ///< in lower case
    std::string port;
    bool operator==(const Address&) const = default;
};

/// Throws Error{usage}: not an address, or one with a user name or password in it, which would be shown and stored.
[[nodiscard]] Address parse_address(const std::string& url);
/// The address that a redirect from `from` leads to; relative ones are resolved. Throws Error{input} when it is none.
[[nodiscard]] Address redirected(const Address& from, const std::string& location);
/// The same host and port, or the same host by https instead of http.
[[nodiscard]] bool stays_on_host(const Address& from, const Address& to);
/// May a token be sent there: encrypted, or to this machine?
[[nodiscard]] bool keeps_secrets(const Address& address);
/// For messages: without what follows "?", which may be a signature.
[[nodiscard]] std::string shown(const Address& address);

}  // namespace isoatlas
