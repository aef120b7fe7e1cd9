#include "methods/surfaces/point_distances.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace isoatlas {

PointDistances::PointDistances(std::span<const Vec3> points, double max) : max_(max), distance_(points.size(), max) {
    const auto cell_of = [](const Vec3& point, std::size_t axis) { return static_cast<std::int64_t>(std::floor(point[axis])); };
    for (std::size_t i = 0; i < points.size(); ++i) {
        points_.push_back({{cell_of(points[i], 0), cell_of(points[i], 1), cell_of(points[i], 2)}, points[i], i});
    }
    const auto row_then_x = [](const Point& p) { return std::tuple(p.cell[2], p.cell[1], p.cell[0], p.number); };
    std::ranges::sort(points_, {}, row_then_x);
    for (std::size_t i = 0; i < points_.size(); ++i) {
        if (i == 0 || points_[i].cell[2] != points_[i - 1].cell[2]) slices_.push_back({points_[i].cell[2], i});
    }
}

void PointDistances::add(const Corners3& triangle) {
    Vec3 low, high;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::tie(low[axis], high[axis]) = std::minmax({triangle[0][axis], triangle[1][axis], triangle[2][axis]});
    }
    const auto look_at = [&](const Point& point) {
        double square = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double beside = std::max({low[axis] - point.place[axis], 0.0, point.place[axis] - high[axis]});
            square += beside * beside;
        }
        double& nearest = distance_[point.number];
        if (square < nearest * nearest) nearest = std::min(nearest, distance_to_triangle(point.place, triangle));
    };
    const auto cell = [this](double at, double by) { return static_cast<std::int64_t>(std::floor(at + by * max_)); };
    const Index3 first{cell(low[0], -1), cell(low[1], -1), cell(low[2], -1)}, last{cell(high[0], 1), cell(high[1], 1), cell(high[2], 1)};
    for (auto slice = std::ranges::lower_bound(slices_, first[2], {}, &Slice::z); slice != slices_.end() && slice->z <= last[2]; ++slice) {
        const std::size_t end = slice + 1 == slices_.end() ? points_.size() : (slice + 1)->first;
        const std::span<const Point> here = std::span<const Point>(points_).subspan(slice->first, end - slice->first);
        const std::int64_t rows = last[1] - first[1] + 1;
        if (std::ssize(here) <= kPointsOfARow * rows) {
            for (const Point& point : here) look_at(point);
            continue;
        }
        const auto row_and_x = [](const Point& p) { return std::pair(p.cell[1], p.cell[0]); };
        for (std::int64_t y = first[1]; y <= last[1]; ++y) {
            for (auto point = std::ranges::lower_bound(here, std::pair(y, first[0]), {}, row_and_x);
                 point != here.end() && row_and_x(*point) <= std::pair(y, last[0]); ++point)
                look_at(*point);
        }
    }
}

}  // namespace isoatlas
