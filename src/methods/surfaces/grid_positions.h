// GridPositions: where points of physical space lie between the samples of a volume.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "isoatlas/volume.h"

namespace isoatlas {

class GridPositions {
public:
    explicit GridPositions(const VolumeInfo& info) : info_(info) {
        const Mat3& m = info.geometry.direction;
        for (std::size_t axis = 0; axis < 3; ++axis) {  // rows of cofactors: the inverse is their transpose over the determinant
            const std::size_t p = (axis + 1) % 3, q = (axis + 2) % 3;
            for (std::size_t row = 0; row < 3; ++row) {
                const std::size_t r = (row + 1) % 3, t = (row + 2) % 3;
                inverse_[axis][row] = m[r][p] * m[t][q] - m[r][q] * m[t][p];
            }
        }
        determinant_ = m[0][0] * inverse_[0][0] + m[1][0] * inverse_[0][1] + m[2][0] * inverse_[0][2];
    }

    /// In steps between samples from the first one.
    [[nodiscard]] Vec3 of(const Vec3& point) const {
        Vec3 place;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            double at = 0;
            for (std::size_t row = 0; row < 3; ++row) at += inverse_[axis][row] * (point[row] - info_.geometry.origin[row]) / determinant_;
            place[axis] = steps_along(axis, at);
        }
        return place;
    }

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

    [[nodiscard]] double steps_along(std::size_t axis, double at) const {
        const std::vector<double>& coordinates = info_.geometry.coordinates[axis];
        if (coordinates.empty()) return at / info_.geometry.spacing[axis];
        if (coordinates.size() == 1) return at - coordinates[0];
        const auto above = std::clamp(std::ranges::upper_bound(coordinates, at), coordinates.begin() + 1, coordinates.end() - 1);
        return static_cast<double>(above - coordinates.begin()) - (*above - at) / (*above - above[-1]);
    }

    const VolumeInfo& info_;
    Mat3 inverse_{};
    double determinant_;
};

}  // namespace isoatlas
