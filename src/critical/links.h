// The link of a voxel: which of its 6 (2D: 4) neighbours lie above it in the total order, as one byte.
//
// Bit 2a: the neighbour before along axis a is above; bit 2a+1: the neighbour behind. Outside the grid is below everything.
// The neighbour before has the smaller voxel number: it must be strictly larger; the one behind may be equal.
// A vertex is regular iff some axis has exactly one neighbour above; else it is critical and k = #axes with both above decides how
// (docs/theory/2-critical-elements.md#voxels: maximum, two saddles, minimum). Multi-saddles do not exist on such grids.
//
// In the literature: upper and lower link (Banchoff, Critical points and curvature for embedded polyhedral surfaces, 1970).
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "field/grid.h"

namespace isoatlas {

/// Writes the links of the voxels of slice z. Reads slices z-1, z, z+1. links.size() == extent.slice().
template <class T>
void links_of_slice(const GridView<T>& grid, std::int64_t z, std::span<std::uint8_t> links);

struct VertexType {
    bool critical;
    std::uint8_t h0, l0;
    std::uint8_t axis = 0;  ///< of a saddle: along it lie the two neighbours above (h0 = 2), else the two below
};

/// Type of a vertex by its link, for grids of rank 2 and 3.
constexpr VertexType vertex_type(std::uint8_t link, int rank) {
    int both = 0;
    std::uint8_t above = 0, below = 0;  // axes
    for (int axis = 0; axis < rank; ++axis) {
        const int bits = link >> (2 * axis) & 3;
        if (bits == 1 || bits == 2) return {false, 1, 1};
        both += bits == 3;
        (bits == 3 ? above : below) = static_cast<std::uint8_t>(axis);
    }
    if (both == 0) return {true, 0, 1};
    if (both == rank) return {true, 1, 0};
    if (rank == 2) return {true, 2, 2, above};
    return both == 1 ? VertexType{true, 2, 1, above} : VertexType{true, 1, 2, below};
}

inline constexpr std::array<std::array<VertexType, 64>, 4> kVertexTypes = [] {
    std::array<std::array<VertexType, 64>, 4> types{};
    for (int rank = 2; rank <= 3; ++rank) {
        for (int link = 0; link < 64; ++link) types[rank][link] = vertex_type(static_cast<std::uint8_t>(link), rank);
    }
    return types;
}();

}  // namespace isoatlas
