// A volume at one isovalue, ready to be cut or extracted.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>

#include "field/sample_grid.h"
#include "levelset/high_bits.h"
#include "levelset/level_bricks.h"

namespace isoatlas {

/// A part of a volume that is processed as a volume of its own.
struct Window {
    Extent whole;   ///< of the volume
    Index3 origin;  ///< first voxel of the part
};

struct TauLevel {
    SampleView volume;  ///< samples are needed at the corners of active cells, and one sample around them for normals
    double tau;
    const HighBits& high;                          ///< of all samples
    const LevelBricks* bricks = nullptr;           ///< of the volume; null: all samples are there
    std::optional<Window> window{};                ///< of what `volume` is a part; voxels are numbered in the part
    std::function<double(std::int64_t)> sample{};  ///< of any voxel, for messages; empty: it is in `volume`

    [[nodiscard]] const VolumeInfo& info() const { return *volume.info; }
    [[nodiscard]] double sample_at(std::int64_t voxel) const {
        if (sample) return sample(voxel);
        return visit_grid(volume, [voxel](const auto& grid) { return static_cast<double>(grid.at(grid.extent.voxel(voxel))); });
    }
};

}  // namespace isoatlas
