// LevelBricks: classes and extremes of the bricks of a volume at one isovalue, known before any sample is read.
#pragma once

#include <cstdint>

#include "field/brick_grid.h"

namespace isoatlas {

/// High or Low as a whole, or divided by the isovalue. The samples of divided bricks are present.
enum class BrickClass : std::uint8_t { low, high, divided };

struct Extremum {
    VoxelId voxel;
    double value;
    /// In the total order (field/order.h).
    [[nodiscard]] bool is_above(const Extremum& other) const { return value != other.value ? value > other.value : voxel > other.voxel; }
};

struct LevelBricks {
    BrickGrid grid;  ///< of the volume, or of the window of the query
    IdArray<BrickId, BrickClass> classes;
    IdArray<BrickId, Extremum> highest, lowest;  ///< of one that has a High, of one that has a Low; voxels are those of the grid.
                                                 ///< Empty where no representatives are needed
};

}  // namespace isoatlas
