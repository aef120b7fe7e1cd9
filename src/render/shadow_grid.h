// Visibility of the key light in the medium: sampled on a coarse grid, interpolated.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "isoatlas/volume.h"

namespace isoatlas {

class ShadowGrid {
public:
    /// Full visibility everywhere.
    ShadowGrid() = default;
    /// light_at: visibility at a position in samples, 0 to 1; called from many threads.
    ShadowGrid(const Extent& extent, const std::function<double(const Vec3&)>& light_at, int threads);

    [[nodiscard]] bool empty() const { return light_.empty(); }
    /// At a position in samples.
    [[nodiscard]] double light(const Vec3& voxel) const;

private:
    Index3 count_{};
    std::vector<float> light_;
};

}  // namespace isoatlas
