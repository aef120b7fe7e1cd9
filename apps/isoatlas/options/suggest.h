// "Did you mean": the nearest of a list of known words.
#pragma once

#include <string>
#include <vector>

namespace isoatlas::cli {

/// The known word at the smallest edit distance, or "" when none is near enough to be a typing error.
[[nodiscard]] std::string nearest(const std::string& word, const std::vector<std::string>& known);

/// "a, b, c"
[[nodiscard]] std::string list_of(const std::vector<std::string>& words);

}  // namespace isoatlas::cli
