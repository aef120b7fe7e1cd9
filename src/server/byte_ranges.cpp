#include "server/byte_ranges.h"

#include <algorithm>

#include "formats/common/text.h"

namespace isoatlas {
namespace {

/// nullopt: not a range. An empty one: outside the file.
std::optional<FileRange> range_of(std::string_view text, std::int64_t size) {
    const std::size_t dash = text.find('-');
    if (dash == std::string_view::npos) return std::nullopt;
    const std::string_view before = text.substr(0, dash), behind = text.substr(dash + 1);
    const std::optional<std::int64_t> first = parse_integer(before), last = parse_integer(behind);
    if (first.value_or(0) < 0 || last.value_or(0) < 0) return std::nullopt;
    if (before.empty()) return last ? std::optional(FileRange{std::max<std::int64_t>(size - *last, 0), size}) : std::nullopt;
    if (!first || (!behind.empty() && (!last || *last < *first))) return std::nullopt;
    if (*first >= size) return FileRange{};
    return FileRange{*first, last ? std::min(*last, size - 1) + 1 : size};
}

}  // namespace

std::optional<std::vector<FileRange>> byte_ranges(std::string_view field, std::int64_t size) {
    constexpr std::string_view kUnit = "bytes=";
    if (!field.starts_with(kUnit)) return std::nullopt;
    field.remove_prefix(kUnit.size());
    std::vector<FileRange> ranges;
    for (std::size_t count = 0;; ++count) {
        const std::size_t comma = field.find(',');
        std::string_view word = field.substr(0, comma);
        while (word.starts_with(' ')) word.remove_prefix(1);
        while (word.ends_with(' ')) word.remove_suffix(1);
        const std::optional<FileRange> range = range_of(word, size);
        if (!range || count == kMostByteRanges) return std::nullopt;
        if (range->bytes() > 0) ranges.push_back(*range);
        if (comma == std::string_view::npos) return ranges;
        field.remove_prefix(comma + 1);
    }
}

}  // namespace isoatlas
