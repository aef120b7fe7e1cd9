#include <algorithm>
#include <cmath>

#include "isoatlas/surface_methods.h"

namespace isoatlas {
namespace {

/// Where points lie along the axes of a grid, in the unit of its spacing.
class AxisPositions {
public:
    explicit AxisPositions(const VolumeInfo& info) : info_(info) {
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
    /// In which ends of the volume a point lies, a bit each.
    [[nodiscard]] unsigned ends_of(const Vec3& point) const {
        constexpr double kNear = 1e-6;  // of a step: points were mapped to physical space and back
        unsigned ends = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            double at = 0;
            for (std::size_t row = 0; row < 3; ++row) at += inverse_[axis][row] * (point[row] - info_.geometry.origin[row]) / determinant_;
            const std::vector<double>& coordinates = info_.geometry.coordinates[axis];
            const std::int64_t count = info_.extent.size[axis];
            const double first = coordinates.empty() ? 0 : coordinates.front();
            const double last =
                coordinates.size() < 2 ? first + info_.geometry.spacing[axis] * static_cast<double>(count - 1) : coordinates.back();
            const double near = kNear * std::abs(last - first) / static_cast<double>(std::max<std::int64_t>(1, count - 1));
            if (std::abs(at - first) <= near) ends |= 1U << (2 * axis);
            if (std::abs(at - last) <= near) ends |= 2U << (2 * axis);
        }
        return ends;
    }

private:
    const VolumeInfo& info_;
    Mat3 inverse_{};
    double determinant_;
};

}  // namespace

std::int64_t count_hole_edges(const Surface& surface, const VolumeInfo& info) {
    const AxisPositions positions(info);
    std::vector<std::array<std::int64_t, 2>> edges;
    for (const auto& t : surface.triangles) {
        for (std::size_t i = 0; i < 3; ++i) edges.push_back({std::min(t[i], t[(i + 1) % 3]), std::max(t[i], t[(i + 1) % 3])});
    }
    std::ranges::sort(edges);
    std::int64_t holes = 0;
    for (std::size_t i = 0; i < edges.size();) {
        const std::size_t begin = i;
        while (i < edges.size() && edges[i] == edges[begin]) ++i;
        if (i - begin == 1)
            holes += (positions.ends_of(surface.points[edges[begin][0]]) & positions.ends_of(surface.points[edges[begin][1]])) == 0;
    }
    return holes;
}

}  // namespace isoatlas
