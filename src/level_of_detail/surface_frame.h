// The points of a surface as they lie in their volume: in the unit of distances, and in which of its faces.
#pragma once

#include <cstdint>
#include <span>

#include "field/voxel_positions.h"
#include "isoatlas/array.h"
#include "isoatlas/level_of_detail.h"

namespace isoatlas {

/// A bit of SurfaceFrame::faces(): the point is at a rim of the surface, an edge with one triangle.
inline constexpr std::uint16_t kRim = 1U << 15;

class SurfaceFrame {
public:
    SurfaceFrame(const Surface& surface, const Geometry& geometry, const Extent& extent, DistanceUnit unit);
    SurfaceFrame(const SurfaceFrame&) = delete;
    SurfaceFrame& operator=(const SurfaceFrame&) = delete;
    ~SurfaceFrame() = default;

    /// The points, where distances are in the unit: an affine map of the points of the surface.
    [[nodiscard]] std::span<const Vec3> scaled() const { return scaled_; }
    /// The step between samples in this unit; the least one of all axes.
    [[nodiscard]] double step() const { return step_; }
    /// Of every point a bit for each face of the volume and each cap in whose plane it lies.
    [[nodiscard]] const Array<std::uint16_t>& faces() const { return faces_; }
    [[nodiscard]] Vec3 scaled(const Vec3& point) const;
    /// The point of the surface that lies at a scaled one.
    [[nodiscard]] Vec3 physical(const Vec3& scaled) const {
        if (unit_ == DistanceUnit::physical) return scaled;
        Vec3 point = even_.origin;
        for (std::size_t row = 0; row < 3; ++row) {
            for (std::size_t axis = 0; axis < 3; ++axis) point[row] += to_space_[row][axis] * scaled[axis];
        }
        return point;
    }

private:
    Array<Vec3> scaled_;
    double step_ = 1;
    DistanceUnit unit_;
    Geometry even_;
    VoxelPositions voxels_;
    Mat3 to_space_{};
    Array<std::uint16_t> faces_;
};

}  // namespace isoatlas
