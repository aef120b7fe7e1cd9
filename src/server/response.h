// The head of an HTTP response.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace isoatlas {

struct ResponseHead {
    int status = 200;
    std::string_view type{};                ///< empty: no body
    std::optional<std::size_t> length = 0;  ///< bytes of the body; nullopt: in chunks, or to the end of the connection (HTTP/1.0)
    std::vector<std::pair<std::string, std::string>> fields{};
    bool keep_alive = false;
    bool is_old = false;         ///< for HTTP/1.0
    bool has_ranges = false;     ///< of a file that stays: ranges of it can be asked for
    bool may_be_framed = false;  ///< by pages of any site
};

/// Includes the empty line at the end and the fields of every response: no store, no referrer, no foreign content, no ranges.
[[nodiscard]] std::string text_of(const ResponseHead& head);

/// A whole small response, after which the connection is closed.
[[nodiscard]] std::string last_answer(ResponseHead head, std::string_view body);

/// A chunk of a body of unknown length; empty: the last one.
[[nodiscard]] std::string chunk(std::string_view bytes);

}  // namespace isoatlas
