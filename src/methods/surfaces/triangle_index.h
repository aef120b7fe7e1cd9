// TriangleIndex: the triangle nearest to a point. Each cell of the grid lists the triangles whose box meets it.
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "isoatlas/volume.h"

namespace isoatlas {

using Corners3 = std::array<Vec3, 3>;  ///< of a triangle, in voxel coordinates

[[nodiscard]] double area_of(const Corners3& triangle);
/// To the nearest point of a triangle; it may be a segment or a point.
[[nodiscard]] double distance_to_triangle(const Vec3& point, const Corners3& triangle);

class TriangleIndex {
public:
    explicit TriangleIndex(std::vector<Corners3> triangles);
    /// Exact, but for rounding; max: the distance is at least that.
    [[nodiscard]] double distance(const Vec3& point, double max) const;

private:
    [[nodiscard]] static std::uint64_t key(const Index3& cell);

    std::vector<Corners3> triangles_;
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> in_cell_;
};

}  // namespace isoatlas
