// The halo of a brick: samples that decide whether a surface needs the brick. A surface reads the corners of active cells and, for normals,
// one sample beyond the ends of active edges; so a brick of one class is needed where a sample of the other class lies
//   - at most two steps along the axes away from it (the end of an edge, and that neighbour), or
//   - in a cell with one of its corners.
#pragma once

#include <algorithm>

#include "field/brick_grid.h"

namespace isoatlas {

inline constexpr std::int64_t kSurroundings = 2;  ///< width of the halo along an axis

/// Samples [begin, end) of a row, those of the brick among them; none: begin >= end.
struct RowPart {
    std::int64_t begin, end;
};

/// The part of row (y, z) that lies in a brick or its halo.
[[nodiscard]] inline RowPart surroundings(const Box& brick, std::int64_t y, std::int64_t z) {
    const auto steps = [&brick](int axis, std::int64_t at) {
        return std::max<std::int64_t>({0, brick.begin[axis] - at, at - brick.end[axis] + 1});
    };
    const std::int64_t along_y = steps(1, y), along_z = steps(2, z);
    std::int64_t reach = kSurroundings - along_y - along_z;
    if (along_y <= 1 && along_z <= 1) reach = std::max<std::int64_t>(reach, 1);
    if (reach < 0) return {0, 0};
    return {brick.begin[0] - reach, brick.end[0] + reach};
}

}  // namespace isoatlas
