// Chooses float32 or float64 positions. Files are indexed, but repair tools weld points by position.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "isoatlas/surface.h"

namespace isoatlas {

enum class Real : std::uint8_t { f32, f64 };

/// f32 when rounding to float32 merges no two points, leaves every triangle an area, and still has at least 2^12 positions along an edge of
/// mean length (largest coordinate <= 2^11 mean edges); f64 otherwise. Cost: O(n log n) time, 8 bytes a point.
/// Does not test for self-intersections, which would cost more than the surface. On axis-aligned grids rounding makes none; on oblique
/// grids sheets that are a rounding error apart may cross (docs/theory/5-surfaces.md, "In files").
[[nodiscard]] Real position_precision(const Surface& surface);

/// Number of points that become equal to another one by rounding to float32. Positions are compared by 64-bit hashes.
[[nodiscard]] std::int64_t points_merged_by_float32(std::span<const std::array<double, 3>> points);

[[nodiscard]] inline std::array<float, 3> to_float(const std::array<double, 3>& point) {
    return {static_cast<float>(point[0]), static_cast<float>(point[1]), static_cast<float>(point[2])};
}

}  // namespace isoatlas
