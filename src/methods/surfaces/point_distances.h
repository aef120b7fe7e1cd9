// PointDistances: how far each of some points is from the nearest of the triangles that come by. The points are few, of the triangles there
// may be many, and long ones: of slices with percolating contours a strip is as long as the slice.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "methods/surfaces/triangle_distance.h"

namespace isoatlas {

class PointDistances {
public:
    /// max: the distance of a point from which all triangles are that far or further. Cost: O(n log n).
    PointDistances(std::span<const Vec3> points, double max);
    /// Cost: O(points of the slices of its box, grown by max), or O(rows of the box, logarithms, points there).
    void add(const Corners3& triangle);
    /// Exact, but for rounding; of the point with this number.
    [[nodiscard]] double operator[](std::size_t number) const { return distance_[number]; }

private:
    static constexpr std::int64_t kPointsOfARow = 8;  ///< of a slice, from which on its rows are looked up

    struct Point {
        Index3 cell;
        Vec3 place;
        std::size_t number;
    };
    struct Slice {
        std::int64_t z;
        std::size_t first;
    };
    double max_;
    std::vector<Point> points_;  ///< by slice, row, cell
    std::vector<Slice> slices_;  ///< that have points
    std::vector<double> distance_;
};

}  // namespace isoatlas
