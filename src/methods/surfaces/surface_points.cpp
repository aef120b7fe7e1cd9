#include "isoatlas/surface_points.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/cancel.h"
#include "field/volume_view.h"
#include "isoatlas/environment.h"
#include "methods/surfaces/cell_divider.h"
#include "methods/surfaces/grid_positions.h"

namespace isoatlas {
namespace {

/// The cell of the middle of a triangle; of caps at the end of the volume the cell beside them.
Index3 cell_of(const Surface& surface, const std::array<std::int64_t, 3>& triangle, const GridPositions& positions, const Extent& extent) {
    Vec3 middle{};
    for (const std::int64_t corner : triangle) {
        for (std::size_t axis = 0; axis < 3; ++axis) middle[axis] += surface.points[corner][axis] / 3;
    }
    const Vec3 place = positions.of(middle);
    Index3 cell;
    for (std::size_t axis = 0; axis < 3; ++axis)
        cell[axis] = std::clamp<std::int64_t>(static_cast<std::int64_t>(std::floor(place[axis])), 0,
                                              std::max<std::int64_t>(0, extent.size[axis] - 2));
    return cell;
}

/// Numbers of the first corners of cells, ascending.
std::vector<std::int64_t> cells_of(const Surface& surface, const VolumeInfo& info, const Context& context) {
    const GridPositions positions(info);
    std::vector<std::int64_t> cells;
    cells.reserve(surface.triangles.size());
    for (const auto& triangle : surface.triangles) cells.push_back(info.extent.index(cell_of(surface, triangle, positions, info.extent)));
    stop_if_cancelled(context);
    std::ranges::sort(cells);
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    return cells;
}

/// Two unit vectors perpendicular to a third one and to each other.
std::array<Vec3, 2> plane_of(const std::array<float, 3>& normal) {
    const Vec3 n{normal[0], normal[1], normal[2]};
    const std::size_t least =
        std::abs(n[0]) < std::abs(n[1]) ? (std::abs(n[0]) < std::abs(n[2]) ? 0 : 2) : (std::abs(n[1]) < std::abs(n[2]) ? 1 : 2);
    const std::size_t p = (least + 1) % 3, q = (least + 2) % 3;
    const double size = std::hypot(n[p], n[q]);
    Vec3 across{};
    across[p] = -n[q] / size, across[q] = n[p] / size;
    const Vec3 up{n[1] * across[2] - n[2] * across[1], n[2] * across[0] - n[0] * across[2], n[0] * across[1] - n[1] * across[0]};
    return {across, up};
}

}  // namespace

SampleBox samples_around(const VolumeInfo& info, const Surface& surface) {
    const GridPositions positions(info);
    SampleBox box{info.extent.size, {0, 0, 0}};
    for (const Vec3& point : surface.points) {
        const Vec3 place = positions.of(point);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto at = static_cast<std::int64_t>(std::floor(place[axis]));
            // The cell before, where the point lies on a sample, and one sample more on both sides for slopes.
            box.begin[axis] = std::max<std::int64_t>(0, std::min(box.begin[axis], at - 2));
            box.end[axis] = std::min(info.extent.size[axis], std::max(box.end[axis], at + 4));
        }
    }
    if (surface.points.empty()) box = {{0, 0, 0}, {1, 1, 1}};
    return box;
}

PointCloud points_of_surface(const Volume& volume, const Surface& surface, int divisions, const Context& context) {
    const EnvironmentScope scope(context);
    (void)make_extractor(SurfaceMethod::dividing_cubes, volume, {.divisions = divisions});  // refuses what it refuses
    PointCloud cloud;
    const Extent& extent = volume.info.extent;
    if (std::ranges::min(extent.size) < 2) return cloud;
    const std::vector<std::int64_t> cells = cells_of(surface, volume.info, context);
    visit_samples(VolumeView(volume), [&]<class T>(std::span<const T> samples) {
        CellDivider<T> divider(volume.info, samples, surface.tau, divisions, cloud);
        for (const std::int64_t cell : cells) (void)divider.divide(extent.voxel(cell));
    });
    return cloud;
}

double disc_radius(const VolumeInfo& info, int divisions) {
    double sum = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::vector<double>& at = info.geometry.coordinates[axis];
        double step = at.size() < 2 ? info.geometry.spacing[axis] : 0;
        for (std::size_t i = 1; i < at.size(); ++i) step = std::max(step, std::abs(at[i] - at[i - 1]));
        sum += step * step;
    }
    return std::sqrt(sum) / (2 * divisions);
}

Surface as_squares(const PointCloud& cloud, double radius) {
    Surface squares;
    squares.points.reserve(4 * cloud.points.size()), squares.triangles.reserve(2 * cloud.points.size());
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
        const auto [across, up] = plane_of(cloud.normals[i]);
        const auto first = std::ssize(squares.points);
        for (const auto& [a, b] : {std::array{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {  // counter-clockwise seen from where the normal points
            Vec3 corner = cloud.points[i];
            for (std::size_t axis = 0; axis < 3; ++axis) corner[axis] += radius * (a * across[axis] + b * up[axis]);
            squares.points.push_back(corner), squares.normals.push_back(cloud.normals[i]);
        }
        squares.triangles.push_back({first, first + 1, first + 2});
        squares.triangles.push_back({first, first + 2, first + 3});
    }
    squares.closed = false;
    return squares;
}

}  // namespace isoatlas
