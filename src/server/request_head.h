// The head of an HTTP request: parsed incrementally from untrusted bytes in bounded memory. Only fields that the server uses are kept.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace isoatlas {

/// Bytes of a request line and header fields in all, and the number of fields.
constexpr std::size_t kLongestHead = 16384;
constexpr int kMaxFields = 100;

struct RequestHead {
    std::string method, target;
    // header fields; empty: not sent
    std::string host, authorization, cookie, client, accept_encoding, range, origin, fetch_site, frame_key;
    bool keep_alive = false;                ///< may the connection be reused?
    bool is_old = false;                    ///< HTTP/1.0: no chunked response
    bool has_body = false;                  ///< a body follows
    std::optional<std::uint64_t> length{};  ///< of the body in bytes; nullopt: not said
};

/// Reads one head.
class HeadReader {
public:
    HeadReader();
    ~HeadReader();

    enum class State : std::uint8_t { more, whole, refused };
    /// Consumes what it can parse from the front of `bytes`, all bytes received so far. O(bytes).
    [[nodiscard]] State read(std::string& bytes);
    /// When the head is complete.
    [[nodiscard]] const RequestHead& head() const;
    /// When the head is rejected: 400, 431 (too long, too many fields) or 505.
    [[nodiscard]] int status() const;

private:
    class Parser;
    std::unique_ptr<Parser> parser_;
    std::size_t taken_ = 0;  ///< bytes
    int status_ = 400;
};

}  // namespace isoatlas
