// CellDivider: the small cubes of a cell that have Highs and Lows, as points (section 3.3). The gradient is interpolated from the samples
// of the cell.
#pragma once

#include <algorithm>
#include <cmath>

#include "isoatlas/surface_methods.h"
#include "mesh/physical_map.h"
#include "methods/surfaces/edge_points.h"

namespace isoatlas {

template <class T>
class CellDivider {
public:
    CellDivider(const VolumeInfo& info, std::span<const T> samples, double tau, int divisions, PointCloud& cloud)
        : info_(info), samples_(samples), tau_(tau), divisions_(divisions), map_(info.geometry, info.extent), cloud_(cloud) {}

    /// Returns whether the cell is active.
    bool divide(const Index3& cell) {
        Corners values;
        for (int corner = 0; corner < 8; ++corner) values[static_cast<std::size_t>(corner)] = value(corner_of(cell, corner));
        const auto [low, high] = std::ranges::minmax(values);
        if (!(low < tau_ && tau_ <= high)) return false;
        std::array<Corners, 3> slopes;
        for (int corner = 0; corner < 8; ++corner) {
            for (std::size_t axis = 0; axis < 3; ++axis)
                slopes[axis][static_cast<std::size_t>(corner)] = slope(corner_of(cell, corner), axis);
        }
        const double step = 1.0 / divisions_;
        for (int z = 0; z < divisions_; ++z) {
            for (int y = 0; y < divisions_; ++y) {
                for (int x = 0; x < divisions_; ++x) add_cube(cell, values, slopes, {x * step, y * step, z * step}, step);
            }
        }
        return true;
    }

private:
    /// One number for each corner of a cell.
    using Corners = std::array<double, 8>;

    /// At a place in the cell, each coordinate 0 to 1.
    [[nodiscard]] static double interpolated(const Corners& corners, const Vec3& at) {
        double sum = 0;
        for (std::size_t corner = 0; corner < 8; ++corner) {
            double weight = corners[corner];
            for (std::size_t axis = 0; axis < 3; ++axis) weight *= (corner >> axis & 1) != 0 ? at[axis] : 1 - at[axis];
            sum += weight;
        }
        return sum;
    }

    [[nodiscard]] double value(const Index3& at) const {
        return static_cast<double>(samples_[static_cast<std::size_t>(info_.extent.index(at))]);
    }

    /// Difference of the neighbours along an axis over their physical distance; at the end of the volume one-sided.
    [[nodiscard]] double slope(const Index3& at, std::size_t axis) const {
        Index3 before = at, behind = at;
        before[axis] = std::max<std::int64_t>(0, at[axis] - 1);
        behind[axis] = std::min(info_.extent.size[axis] - 1, at[axis] + 1);
        return (value(behind) - value(before)) * map_.inverse_distance(static_cast<int>(axis))[at[axis]];
    }

    void add_cube(const Index3& cell, const Corners& values, const std::array<Corners, 3>& slopes, const Vec3& from, double step) {
        int highs = 0;
        for (std::size_t corner = 0; corner < 8; ++corner) {
            Vec3 at = from;
            for (std::size_t axis = 0; axis < 3; ++axis) at[axis] += (corner >> axis & 1) != 0 ? step : 0;
            highs += static_cast<int>(interpolated(values, at) >= tau_);
        }
        if (highs == 0 || highs == 8) return;
        Vec3 middle, position, slope;
        for (std::size_t axis = 0; axis < 3; ++axis) middle[axis] = from[axis] + step / 2;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            position[axis] = static_cast<double>(cell[axis]) + middle[axis];
            slope[axis] = interpolated(slopes[axis], middle);
        }
        cloud_.points.push_back(map_.point(position));
        cloud_.normals.push_back(map_.normal(slope, 0, 1));
    }

    const VolumeInfo& info_;
    std::span<const T> samples_;
    double tau_;
    int divisions_;
    PhysicalMap map_;
    PointCloud& cloud_;
};

}  // namespace isoatlas
