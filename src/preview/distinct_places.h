// Places of a surface on a lattice, no two the same: rounding alone would weld points that are closer than a step, and a file format
// without indices (STL) would then have a surface that is not a manifold.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace isoatlas {

using LatticePlace = std::array<std::uint16_t, 3>;

/// Moves points, by a few steps each and as few of them as it can, until no two have the same place and no triangle has zero area.
/// corners: three for each triangle, numbers of places. Returns how many triangles without area are left: 0 unless the lattice is too
/// coarse for the surface. Cost: O(points + triangles), 100 bytes of memory a point.
std::size_t make_places_distinct(std::span<LatticePlace> places, std::span<const unsigned> corners);

}  // namespace isoatlas
