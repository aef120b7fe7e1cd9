// From voxel positions and voxel differences to physical points and normals.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "isoatlas/volume.h"

namespace isoatlas {

/// Vectors side by side, one array for each component, so that the compiler works on several at once.
inline constexpr std::size_t kLanes = 256;
template <class Real>
using Lanes = std::array<std::array<Real, kLanes>, 3>;
/// Loops over lanes run to a whole number of these: lanes behind the last one are computed and ignored.
[[nodiscard]] constexpr std::size_t whole_lanes(std::size_t count) { return (count + 15) / 16 * 16; }

class PhysicalMap {
public:
    /// Throws Error{usage} when the axes of the geometry do not span space.
    PhysicalMap(const Geometry& geometry, const Extent& extent);

    /// to_physical of the geometry; one matrix product unless the grid is rectilinear.
    [[nodiscard]] Vec3 point(const Vec3& voxel) const {
        if (rectilinear_) return to_physical(geometry_, voxel);
        Vec3 physical = geometry_.origin;
        for (int row = 0; row < 3; ++row) {
            physical[row] += matrix_[row][0] * voxel[0] + matrix_[row][1] * voxel[1] + matrix_[row][2] * voxel[2];
        }
        return physical;
    }

    /// The same for `count` positions at once, and some behind them up to whole_lanes(count); here and below.
    [[gnu::always_inline]] void to_points(std::size_t count, Lanes<double>& voxel) const {
        if (rectilinear_) return to_points_one_by_one(count, voxel);
        const Mat3 m = matrix_;
        const Vec3 origin = geometry_.origin;
        for (std::size_t i = 0; i < whole_lanes(count); ++i) {
            const double x = voxel[0][i], y = voxel[1][i], z = voxel[2][i];
            for (std::size_t row = 0; row < 3; ++row) voxel[row][i] = origin[row] + (m[row][0] * x + m[row][1] * y + m[row][2] * z);
        }
    }

    /// 1 / (distance along the axis between the neighbours of sample i that exist); 0 when there is no neighbour.
    [[nodiscard]] const double* inverse_distance(int axis) const { return inverse_distance_[axis].data(); }

    /// Unit normal towards lower values. slope: change of the value per unit of length along each axis. When it is zero or not finite,
    /// the normal is that of a value that falls along `axis` in the direction `sign`. Real: float is enough for small sample types.
    template <class Real>
    [[nodiscard]] std::array<float, 3> normal(const std::array<Real, 3>& slope, int axis, double sign) const {
        std::array<Real, 3> g;
        for (int row = 0; row < 3; ++row) {
            g[row] = static_cast<Real>(normals_[row][0]) * slope[0] + static_cast<Real>(normals_[row][1]) * slope[1] +
                     static_cast<Real>(normals_[row][2]) * slope[2];
        }
        const Real squared = g[0] * g[0] + g[1] * g[1] + g[2] * g[2];
        if (is_degenerate(squared)) return degenerate_normal({slope[0], slope[1], slope[2]}, axis, sign);
        const Real scale = Real(-1) / std::sqrt(squared);
        return {static_cast<float>(g[0] * scale), static_cast<float>(g[1] * scale), static_cast<float>(g[2] * scale)};
    }

    /// The same for `count` slopes at once, but for degenerate ones, which are zero, not finite, or too large or too small to be squared:
    /// true in `degenerate`.
    template <class Real>
    [[gnu::always_inline]] void to_normals(std::size_t count, Lanes<Real>& slope, std::array<bool, kLanes>& degenerate) const {
        std::array<std::array<Real, 3>, 3> m;
        for (std::size_t row = 0; row < 3; ++row) {
            for (std::size_t k = 0; k < 3; ++k) m[row][k] = static_cast<Real>(normals_[row][k]);
        }
        for (std::size_t i = 0; i < whole_lanes(count); ++i) {
            std::array<Real, 3> g;
            for (std::size_t row = 0; row < 3; ++row) g[row] = m[row][0] * slope[0][i] + m[row][1] * slope[1][i] + m[row][2] * slope[2][i];
            const Real squared = g[0] * g[0] + g[1] * g[1] + g[2] * g[2];
            const bool leave = is_degenerate(squared);
            const Real scale = Real(-1) / std::sqrt(squared);
            degenerate[i] = leave;
            for (std::size_t row = 0; row < 3; ++row) slope[row][i] = leave ? slope[row][i] : g[row] * scale;
        }
    }
    /// The normal of a degenerate slope.
    [[nodiscard]] std::array<float, 3> degenerate_normal(Vec3 slope, int axis, double sign) const;

private:
    void to_points_one_by_one(std::size_t count, Lanes<double>& voxel) const;
    template <class Real>
    [[nodiscard]] static bool is_degenerate(Real squared) {
        return !(squared > Real(1e-25) && squared < Real(1e25));
    }

    const Geometry& geometry_;
    bool rectilinear_;
    Mat3 matrix_;   ///< voxel steps to physical steps
    Mat3 normals_;  ///< inverse transpose of the directions: slopes along the axes to the physical gradient
    std::array<std::vector<double>, 3> inverse_distance_;
};

}  // namespace isoatlas
