#include "level_of_detail/surface_frame.h"

#include <algorithm>
#include <cmath>

#include "isoatlas/error.h"
#include "mesh/place_hits.h"

namespace isoatlas {
namespace {

/// Along an axis: the first sample and the last one, where open surfaces end, and the caps just beyond them.
std::array<double, 4> planes_of(const Geometry& geometry, const Extent& extent, std::size_t axis) {
    const std::vector<double>& coordinates = geometry.coordinates[axis];
    double first = 0, last = geometry.spacing[axis] * static_cast<double>(extent.size[axis] - 1);
    double first_step = geometry.spacing[axis], last_step = first_step;
    if (!coordinates.empty()) first = coordinates.front(), last = coordinates.back();
    if (coordinates.size() > 1) first_step = coordinates[1] - first, last_step = last - coordinates[coordinates.size() - 2];
    return {first, last, first - kHitMargin * first_step, last + kHitMargin * last_step};
}

}  // namespace

Vec3 SurfaceFrame::scaled(const Vec3& point) const { return unit_ == DistanceUnit::physical ? point : voxels_.of(point); }

SurfaceFrame::SurfaceFrame(const Surface& surface, const Geometry& geometry, const Extent& extent, DistanceUnit unit)
    : unit_(unit), even_(with_smallest_steps(geometry)), voxels_(even_) {
    if (!voxels_.is_unique()) throw Error(ErrorKind::usage, {.what = "the axes of the geometry do not span space"});
    const Vec3 step = even_.spacing;
    step_ = unit == DistanceUnit::voxel ? 1 : std::min({step[0], step[1], step[2]});
    for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t axis = 0; axis < 3; ++axis) to_space_[row][axis] = geometry.direction[row][axis] * step[axis];
    }
    scaled_.resize(surface.points.size());
    faces_.assign(surface.points.size(), 0);
    for (std::size_t i = 0; i < scaled_.size(); ++i) {
        const Vec3 voxel = voxels_.of(surface.points[i]);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::array<double, 4> planes = planes_of(geometry, extent, axis);
            for (std::size_t plane = 0; plane < 4; ++plane) {
                const bool is_in_plane = std::abs(voxel[axis] * step[axis] - planes[plane]) <= 1e-5 * step[axis];
                faces_[i] = static_cast<std::uint16_t>(faces_[i] | (is_in_plane ? 1U << (4 * axis + plane) : 0U));
            }
        }
        scaled_[i] = unit == DistanceUnit::physical ? surface.points[i] : voxel;
    }
}

}  // namespace isoatlas
