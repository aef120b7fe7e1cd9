// Labels: volumes whose samples are names of regions, not measurements. Isovalues between two labels mean nothing; each label is a volume
// of its own: 1 where a sample has the label, 0 elsewhere, cut at 1/2.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "isoatlas/interpolant.h"
#include "isoatlas/surface.h"
#include "isoatlas/volume.h"

namespace isoatlas {

/// The region of one label. Counts are those of cut() of its own volume at 1/2: voxels that touch along an edge belong together.
struct LabelRegion {
    std::int64_t label = 0;
    std::int64_t voxels = 0;
    double measure = 0;  ///< physical volume (area in 2D): sum of voxel boxes
    std::int64_t components = 0, tunnels = 0, cavities = 0;
    Index3 box_low{}, box_high{};  ///< inclusive voxel bounds
    Vec3 position{};               ///< mean of its voxels, in voxels
};

struct LabelTable {
    std::vector<LabelRegion> regions;  ///< ascending labels; without 0, the background
    std::int64_t background = 0;       ///< voxels of label 0
};

struct LabelOptions {
    Interpolant interpolant = Interpolant::trilinear;
    /// More different values are refused.
    std::int64_t max_labels = 65536;
};

/// All labels of a volume. Throws Error: input (a sample is not a whole number of at least 0, or there are too many labels), cancelled.
/// Cost: two passes over the volume, and a cut of the box of each label; memory: a byte for each voxel of the largest box, and what cut()
/// takes for it.
[[nodiscard]] LabelTable list_labels(const Volume& volume, const LabelOptions& options = {}, const Context& context = {});

/// The surface around the voxels of one label, half-way to its neighbours, where the label lies in space. Surface::object is the label,
/// Surface::reported_tau too; contours are numbers of voxels of the whole volume. options: objects and contours are left out of account.
/// Throws Error: not_found (no sample has the label), else as list_labels(). Cost: a pass over the volume and extract() of its box.
[[nodiscard]] Surface extract_label(const Volume& volume, std::int64_t label, const ExtractOptions& options = {},
                                    const Context& context = {});

}  // namespace isoatlas
