// A cell (voxel cube) and its parts as numbers.
//
// Corner k = x + 2y + 4z, x y z in {0,1}. Axis a has the bit 1 << a.
// Edge e = 4a + j: along axis a, j = 0..3 numbers the other two coordinates (lower axis first).
// Face f = 2o + side: orientation o in {0: xy, 1: xz, 2: yz}, side 0 or 1 along the normal axis (z, y, x).
// Face corners run around: a = base, b = base + axis1, c = base + axis1 + axis2, d = base + axis2 (axis1 < axis2), so the
// diagonals are {a, c} and {b, d}, and voxel numbers ascend a < b < d < c.
// High pattern: bit k set when corner k is High. Joined mask: bit f set when the Highs of an ambiguous face f are joined across it.
#pragma once

#include <array>
#include <cstdint>

namespace isoatlas {

struct FaceAxes {
    int axis1, axis2, normal;
};
inline constexpr std::array<FaceAxes, 3> kFaceAxes{{{0, 1, 2}, {0, 2, 1}, {1, 2, 0}}};

/// Corners a, b, c, d of face f.
inline constexpr std::array<std::array<int, 4>, 6> kFaceCorners = [] {
    std::array<std::array<int, 4>, 6> corners{};
    for (int f = 0; f < 6; ++f) {
        const FaceAxes axes = kFaceAxes[f / 2];
        const int base = (f & 1) << axes.normal;
        corners[f] = {base, base | 1 << axes.axis1, base | 1 << axes.axis1 | 1 << axes.axis2, base | 1 << axes.axis2};
    }
    return corners;
}();

/// The two corners of edge e, the lower voxel number first.
inline constexpr std::array<std::array<int, 2>, 12> kEdgeCorners = [] {
    std::array<std::array<int, 2>, 12> corners{};
    for (int axis = 0; axis < 3; ++axis) {
        const int first = axis == 0 ? 1 : 0;
        const int second = axis == 2 ? 1 : 2;
        for (int j = 0; j < 4; ++j) {
            const int base = (j & 1) << first | (j >> 1) << second;
            corners[4 * axis + j] = {base, base | 1 << axis};
        }
    }
    return corners;
}();

/// The edge between two neighbouring corners.
constexpr int edge_between(int corner, int other) {
    const int bit = corner ^ other;
    const int axis = bit == 1 ? 0 : bit == 2 ? 1 : 2;
    const int base = corner & other;
    const int first = axis == 0 ? 1 : 0;
    const int second = axis == 2 ? 1 : 2;
    return 4 * axis + ((base >> first & 1) | (base >> second & 1) << 1);
}

/// A face is split by a High pattern when exactly one of its diagonals is High.
constexpr bool face_is_split(int pattern, int f) {
    const std::array<int, 4>& c = kFaceCorners[f];
    const int a = pattern >> c[0] & 1, b = pattern >> c[1] & 1, cc = pattern >> c[2] & 1, d = pattern >> c[3] & 1;
    return a == cc && b == d && a != b;
}

/// High region of each corner of a cell: region[k] = smallest corner of its region, Lows get 8 + smallest corner of their region.
/// Highs are connected by cell edges and across split faces whose joined bit is set; Lows by cell edges and across the other split faces.
/// Theory: docs/theory/1-elements-and-order.md#objects-low-components-contours. Regions that a tunnel joins through the interior are two
/// here (critical/open_tunnel.h).
std::array<std::uint8_t, 8> cell_regions(int pattern, int joined);

/// Lookup tables for default face types; 256 patterns, made once.
struct CellTable {
    /// Bit f: face f is split by the pattern.
    std::array<std::uint8_t, 256> split;
    /// [64 * pattern + joined] bit f: f is split and its Highs lie in one region of the cell, counting the joined bits except f's own.
    std::array<std::uint8_t, 256 * 64> highs_joined;
};
const CellTable& cell_table();

}  // namespace isoatlas
