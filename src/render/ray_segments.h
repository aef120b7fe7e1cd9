// A ray in segments that end at multiples of a step plus a shift; the first and the last one are shorter. A segment is evaluated entirely
// or not at all, so that empty-space skipping, or splitting a ray in empty space, does not change the result.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "isoatlas/volume.h"

namespace isoatlas {

inline constexpr std::size_t kLanes = 8;  ///< segments evaluated at a time

// Vectors of gcc and clang: lowered to what the processor has.
using EightFloats = float __attribute__((vector_size(4 * kLanes)));
using EightIntegers = std::int32_t __attribute__((vector_size(4 * kLanes)));
using FourDoubles = double __attribute__((vector_size(32)));

struct RaySegments {
    Vec3 origin, way;    ///< of the ray, in samples
    double step, first;  ///< begin of the first segment, in steps
    double begin, end;   ///< t of the whole
    [[nodiscard]] double end_of(std::int64_t segment) const {
        return std::clamp((first + static_cast<double>(segment + 1)) * step, begin, end);
    }
    [[nodiscard]] std::int64_t number_at(double t) const { return static_cast<std::int64_t>(t / step - first); }
};

/// Begin of the first of some segments, and the end of each: t, and the position of its value in the table of a transfer function.
struct SegmentEnds {
    std::array<double, kLanes + 1> t;
    std::array<float, kLanes + 1> place{};
    std::size_t count = 0;  ///< segments
};

}  // namespace isoatlas
