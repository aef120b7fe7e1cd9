// A surface in the cells of an octree, level by level, as viewers load it that show far parts coarser than near ones.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "isoatlas/cluster_hierarchy.h"
#include "isoatlas/vec3.h"

namespace isoatlas {

/// The part of a level in one cell.
struct OctreeFragment {
    std::array<std::int64_t, 3> place{};                  ///< of the cell, in cells of the level, x y z
    std::vector<Vec3> points;                             ///< in voxels: the first sample of the volume is at 0 0 0
    std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise from outside, as those of the surface
};

struct OctreeLevel {
    double distance = 0;                    ///< from the exact surface, at most, both ways; in voxels
    std::vector<OctreeFragment> fragments;  ///< along a Z-order curve, x fastest; none is empty
};

struct OctreeMesh {
    std::int64_t edge = 0;            ///< of a cell of level 0, in voxels; twice as long with each level
    std::vector<OctreeLevel> levels;  ///< level 0 is the exact surface
};

struct OctreeOptions {
    std::int64_t edge = 64;        ///< of a cell of level 0, in voxels; 1 or more
    double first_distance = 0.25;  ///< what level 1 may deviate, in voxels; each further level may add twice as much
};

/// Cells whose surface is simplified cell by cell: of level k + 1, what lies in each cell of level k, while all points in the faces between
/// cells stay. So a viewer may mix levels: let it show every part of the volume once, by a cell of some level or an eighth of one (the
/// triangles of level k + 1 cross no face of a cell of level k). What it shows has the contours of `surface`, each with its genus, nested
/// alike, closed where `surface` is, without crossings and without cracks: neighbours of any two levels have the same points in common.
/// This is the theorem of make_clusters() for groups that are cells (docs/theory/10-level-of-detail.md).
/// surface: of Atlas::extract() or extract(), or of any triangles that do not cross the planes between cells. Throws Error: usage (they do;
/// options out of range), unsupported (a rectilinear grid, whose cells are no cubes; curves of a 2D image), otherwise as make_clusters().
/// The same bytes for any number of threads. Cost: some 100 us a triangle on one processor. Memory: as make_clusters().
[[nodiscard]] OctreeMesh make_octree_mesh(const Surface& surface, const Geometry& geometry, const Extent& extent,
                                          const OctreeOptions& options = {}, const Context& context = {});

}  // namespace isoatlas
