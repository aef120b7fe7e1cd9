// extract --octree, --octree-error, --octree-pixels, --eye: surfaces by blocks of cells
#pragma once

#include <string>

#include <isoatlas/isoatlas.h>

#include "options/arguments.h"
#include "text/document.h"

namespace isoatlas::cli {

/// What was drawn by blocks, of all surfaces together.
struct OctreeUse {
    OctreeArguments asked{};
    double deviation = 0;                ///< in voxels; infinity: it was not measured
    double pixels = 0;                   ///< from the eye; infinity: there is none
    std::vector<std::int64_t> leaves{};  ///< of blocks 1, 2, 4, ... cells wide

    [[nodiscard]] FrontOptions options(const Geometry& geometry) const;
    /// Adds what was done.
    [[nodiscard]] Surface take(FrontSurface front);
    OctreeUse& operator+=(const OctreeUse& other);
};

/// Throws Error{usage} for options that contradict --octree.
void check_octree(const Arguments& arguments);

/// "blocks of cells: 402 of 8, 1233 of 4, 4603 of 1; points of the exact surface within 0.5 voxels, with the same topology"
[[nodiscard]] std::string octree_text(const OctreeUse& use);
[[nodiscard]] Json octree_json(const OctreeUse& use);

}  // namespace isoatlas::cli
