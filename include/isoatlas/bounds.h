// Bounds: an interval that contains a number.
#pragma once

#include <cstdint>

namespace isoatlas {

/// A number that is known exactly when both are equal.
struct Bounds {
    std::int64_t min = 0, max = 0;
};

}  // namespace isoatlas
