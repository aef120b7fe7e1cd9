#include <algorithm>
#include <cmath>

#include "isoatlas/surface_methods.h"
#include "methods/surfaces/voxel_positions.h"

namespace isoatlas {
namespace {

/// In which ends of the volume a point lies, a bit each.
unsigned ends_of(const Vec3& voxel, const Index3& size) {
    constexpr double kNear = 1e-6;  // points were mapped to physical space and back
    unsigned ends = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (std::abs(voxel[axis]) <= kNear) ends |= 1U << (2 * axis);
        if (std::abs(voxel[axis] - static_cast<double>(size[axis] - 1)) <= kNear) ends |= 2U << (2 * axis);
    }
    return ends;
}

}  // namespace

std::int64_t count_hole_edges(const Surface& surface, const VolumeInfo& info) {
    const VoxelPositions positions(info.geometry);
    const auto ends = [&](std::int64_t point) {
        return ends_of(positions.of(surface.points[static_cast<std::size_t>(point)]), info.extent.size);
    };
    std::vector<std::array<std::int64_t, 2>> edges;
    for (const auto& t : surface.triangles) {
        for (std::size_t i = 0; i < 3; ++i) edges.push_back({std::min(t[i], t[(i + 1) % 3]), std::max(t[i], t[(i + 1) % 3])});
    }
    std::ranges::sort(edges);
    std::int64_t holes = 0;
    for (std::size_t i = 0; i < edges.size();) {
        const std::size_t begin = i;
        while (i < edges.size() && edges[i] == edges[begin]) ++i;
        if (i - begin == 1) holes += (ends(edges[begin][0]) & ends(edges[begin][1])) == 0;
    }
    return holes;
}

}  // namespace isoatlas
