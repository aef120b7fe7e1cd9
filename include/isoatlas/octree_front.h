// The surface of any isovalue by blocks of an octree, coarse where it may be, nothing prepared: for an isovalue that moves.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "isoatlas/surface.h"
#include "isoatlas/viewpoint.h"

namespace isoatlas {

struct FrontOptions {
    /// Blocks are at most 2^max_level cells wide, 0 .. 5; 0: the exact surface.
    int max_level = 3;
    /// Smaller blocks where about so many triangles allow them, of all objects; 0: blocks are as large as may be.
    std::int64_t triangles = 0;
    /// How far the points of the exact surface on edges of the grid may be from the front, in voxels; infinity: blocks are as large as the
    /// topology allows, which is fast: no distance is measured.
    double deviation = std::numeric_limits<double>::infinity();
    /// Instead of one deviation everywhere: from where the front is seen, and how many pixels these points may be from it there. Blocks are
    /// smaller where they are near. Physical, also where steps are uneven.
    std::optional<Viewpoint> from{};
    double pixels = 1;
    /// Regions of interest: the exact surface inside these samples.
    std::vector<SampleBox> exact{};
    /// The exact surface where all objects together have at most so many triangles; 0: always a front. Found by one search of both.
    std::int64_t exact_triangles = 0;
    /// The exact surface, too, where it has more than so many triangles, unless SurfaceOptions::max_triangles refuses it: a front would
    /// have too many as well, and takes longer; 0: never.
    std::int64_t exact_above = 0;
    /// Where exact_above asks for the exact surface, about so many of its points on edges of the grid in place of it, which takes half the
    /// time; 0: the surface.
    std::int64_t points = 0;
};

struct FrontSurface {
    Surface surface;
    /// How many blocks of each level hold a part of all objects; of level 0: cells. Empty: the exact surface instead.
    std::vector<std::int64_t> leaves;
    double deviation = std::numeric_limits<double>::infinity();  ///< as it was measured; infinity: it was not
    double pixels = std::numeric_limits<double>::infinity();     ///< as it is seen, at most; infinity: from nowhere
    /// More than 0: `surface` has points and normals alone, without triangles and ids, and so much area, squared, for each. Physical.
    double spacing = 0;
};

/// The surface at tau with the same contours, genus and nesting as that of extract(), and fewer triangles: in a block of cells where it is
/// one disk, and stays one on the block's faces and edges, it is a fan of triangles around a point of it. Points of the front are points
/// of the exact surface, where edges of blocks meet it, but for some inside a block. Neighbours may be of any two levels: there are no
/// cracks and no rules of balance. Closed, embedded, oriented as extract(); docs/theory/10-level-of-detail.md#octree-fronts has the proof.
/// A block qualifies by the classes of its samples alone, words of bits at a time.
/// how: of extract(); objects and contours are chosen, and points have ids, as there. Throws Error: usage (options out of range; tau not
/// finite; Boundary::open), unsupported (a 2D image), otherwise as extract(). The same bytes for any number of threads. Cost: O(volume)
/// scan to classify, some nanoseconds a cell near the surface, plus O(triangles of the front); with a deviation some 100 ns for each active
/// cell and level. Memory: 2 bits a voxel, some 300 bytes a block.
[[nodiscard]] FrontSurface extract_front(const Volume& volume, double tau, const FrontOptions& options = {}, const ExtractOptions& how = {},
                                         const Context& context = {});

}  // namespace isoatlas
