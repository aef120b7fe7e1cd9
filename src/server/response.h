// The head of an answer, as HTTP carries it.
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
    std::string_view type{};                ///< empty: there is nothing behind the head
    std::optional<std::size_t> length = 0;  ///< bytes behind it; nothing: in chunks, or to the end of the connection (HTTP/1.0)
    std::vector<std::pair<std::string, std::string>> fields{};
    bool keep_alive = false;
    bool is_old = false;  ///< for HTTP/1.0
};

/// With the empty line that ends it, and the fields of every answer: no store, no referrer, no foreign content, no ranges.
[[nodiscard]] std::string text_of(const ResponseHead& head);

/// A whole small answer, after which the connection is closed.
[[nodiscard]] std::string last_answer(ResponseHead head, std::string_view body);

/// A piece of what has no length; empty: the last one.
[[nodiscard]] std::string chunk(std::string_view bytes);

}  // namespace isoatlas
