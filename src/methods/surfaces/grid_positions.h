// GridPositions: where points of physical space lie between the samples of a volume.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include "field/voxel_positions.h"

namespace isoatlas {

class GridPositions {
public:
    explicit GridPositions(const VolumeInfo& info) : info_(info), positions_(info.geometry) {}

    /// In steps between samples from the first one.
    [[nodiscard]] Vec3 of(const Vec3& point) const { return positions_.of(point); }

    /// In which ends of the volume a point lies, a bit each.
    [[nodiscard]] unsigned ends_of(const Vec3& point) const {
        const Vec3 place = of(point);
        unsigned ends = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (std::abs(place[axis]) <= kNear) ends |= 1U << (2 * axis);
            if (std::abs(place[axis] - static_cast<double>(info_.extent.size[axis] - 1)) <= kNear) ends |= 2U << (2 * axis);
        }
        return ends;
    }

    /// The number of the edge between neighbouring samples that a point lies inside; none: on a sample, in a face, in a cell.
    [[nodiscard]] std::optional<std::int64_t> edge_of(const Vec3& point) const {
        const Vec3 place = of(point);
        Index3 sample;
        int axis_between = -1;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double nearest = std::round(place[axis]);
            const bool is_between = std::abs(place[axis] - nearest) > kNear;
            if (is_between && axis_between >= 0) return std::nullopt;
            if (is_between) axis_between = static_cast<int>(axis);
            sample[axis] = static_cast<std::int64_t>(is_between ? std::floor(place[axis]) : nearest);
        }
        if (axis_between < 0) return std::nullopt;
        return 3 * info_.extent.index(sample) + axis_between;
    }

private:
    static constexpr double kNear = 1e-6;  ///< of a step: points were mapped to physical space and back

    const VolumeInfo& info_;
    VoxelPositions positions_;
};

}  // namespace isoatlas
