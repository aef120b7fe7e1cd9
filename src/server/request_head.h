// A request as HTTP carries it, without its body: read byte for byte from anybody, in bounded memory. Only what the server looks at is
// kept.
#pragma once

#include <memory>
#include <string>

namespace isoatlas {

/// Bytes of a request line and header fields in all, and the number of fields.
constexpr std::size_t kLongestHead = 16384;
constexpr int kMaxFields = 100;

struct RequestHead {
    std::string method, target;
    // header fields; empty: not sent
    std::string host, authorization, cookie, client, accept_encoding, origin, fetch_site;
    bool keep_alive = false;  ///< may the connection go on?
    bool is_old = false;      ///< HTTP/1.0: no answer in chunks
    bool has_body = false;    ///< it follows, and is not read
};

/// Reads one head.
class HeadReader {
public:
    HeadReader();
    ~HeadReader();

    enum class State : std::uint8_t { more, whole, refused };
    /// Takes what it can use from the front of `bytes`, of all that have come. Bounded time: O(bytes).
    [[nodiscard]] State read(std::string& bytes);
    /// When it is whole.
    [[nodiscard]] const RequestHead& head() const;
    /// When it is refused: 400, 431 (too long, too many fields) or 505.
    [[nodiscard]] int status() const;

private:
    class Parser;
    std::unique_ptr<Parser> parser_;
    std::size_t taken_ = 0;  ///< bytes
    int status_ = 400;
};

}  // namespace isoatlas
