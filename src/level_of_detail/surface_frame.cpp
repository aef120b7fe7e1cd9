#include "level_of_detail/surface_frame.h"

#include <algorithm>
#include <cmath>

#include "field/voxel_positions.h"
#include "geometry/orientation.h"
#include "isoatlas/error.h"
#include "mesh/place_hits.h"

namespace isoatlas {
namespace {

double determinant(const Mat3& m) {
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

Mat3 inverse(const Mat3& m) {
    const double scale = 1 / determinant(m);
    Mat3 result{};
    for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t column = 0; column < 3; ++column) {
            const std::size_t a = (column + 1) % 3, b = (column + 2) % 3, c = (row + 1) % 3, d = (row + 2) % 3;
            result[row][column] = scale * (m[a][c] * m[b][d] - m[a][d] * m[b][c]);
        }
    }
    return result;
}

Vec3 times(const Mat3& m, const Vec3& p) {
    Vec3 result{};
    for (std::size_t row = 0; row < 3; ++row) result[row] = m[row][0] * p[0] + m[row][1] * p[1] + m[row][2] * p[2];
    return result;
}

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

Vec3 SurfaceFrame::scaled(const Vec3& point) const {
    return unit_ == DistanceUnit::physical ? point : times(to_voxels_, minus(point, origin_));
}

SurfaceFrame::SurfaceFrame(const Surface& surface, const Geometry& geometry, const Extent& extent, DistanceUnit unit)
    : unit_(unit), origin_(geometry.origin) {
    if (determinant(geometry.direction) == 0) throw Error(ErrorKind::usage, {.what = "the axes of the geometry do not span space"});
    const Mat3 to_axes = inverse(geometry.direction);  // lengths along the axes
    const Vec3 step = with_smallest_steps(geometry).spacing;
    step_ = unit == DistanceUnit::voxel ? 1 : std::min({step[0], step[1], step[2]});
    for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            to_space_[row][axis] = geometry.direction[row][axis] * step[axis];
            to_voxels_[row][axis] = to_axes[row][axis] / step[row];
        }
    }
    scaled_.resize(surface.points.size());
    faces_.assign(surface.points.size(), 0);
    for (std::size_t i = 0; i < scaled_.size(); ++i) {
        const Vec3 along = times(to_axes, minus(surface.points[i], origin_));
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::array<double, 4> planes = planes_of(geometry, extent, axis);
            for (std::size_t plane = 0; plane < 4; ++plane) {
                const bool is_in_plane = std::abs(along[axis] - planes[plane]) <= 1e-5 * step[axis];
                faces_[i] = static_cast<std::uint16_t>(faces_[i] | (is_in_plane ? 1U << (4 * axis + plane) : 0U));
            }
        }
        scaled_[i] = scaled(surface.points[i]);
    }
}

}  // namespace isoatlas
