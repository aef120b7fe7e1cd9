// Natural sort order: runs of digits compare as numbers, so slice2 comes before slice10.
#pragma once

#include <string_view>

namespace isoatlas {

/// A strict weak order; names that differ only in leading zeros are ordered by their bytes.
[[nodiscard]] bool natural_less(std::string_view a, std::string_view b);

}  // namespace isoatlas
