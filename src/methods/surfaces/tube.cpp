#include "methods/surfaces/tube.h"

#include <algorithm>
#include <limits>

#include "methods/surfaces/triangle_distance.h"

namespace isoatlas {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// Strips between two polygons that run the same way round, from the chord between a corner of one and a corner of the other back to it.
/// They begin with an edge of one and end with an edge of the other, as every strip does somewhere. Then no chord comes twice, unless all
/// edges of one come first.
class Strips {
public:
    Strips(std::span<const std::uint8_t> one, std::vector<std::uint8_t> other, const std::array<Vec3, 12>& at)
        : one_(one), other_(std::move(other)), at_(at) {}

    /// Area of the smallest one, and its triangles.
    double smallest(std::size_t from_one, std::size_t from_other, std::vector<HitTriangle>& triangles) {
        const std::size_t m = one_.size(), n = other_.size();
        std::array<std::array<double, 13>, 13> sum{};  // of the smallest way to chord (i, j)
        for (std::size_t i = 0; i <= m; ++i) {
            for (std::size_t j = 0; j <= n; ++j) {
                if (i + j == 0) continue;
                const double by_one = i == 0 ? kNever : sum[i - 1][j] + area(on_one(from_one + i - 1, from_other + j));
                const double by_other = j == 0 ? kNever : sum[i][j - 1] + area(on_other(from_one + i, from_other + j - 1));
                const bool is_out = (i == 0 && j > 0) || (i < m && j == n) || (i == m && j == 0);
                sum[i][j] = is_out ? kNever : std::min(by_one, by_other);
                is_on_one_[i][j] = by_one <= by_other;
            }
        }
        triangles.clear();
        for (std::size_t i = m, j = n; i + j > 0;) {
            const bool is_on_one = j == 0 || (i > 0 && is_on_one_[i][j]);
            --(is_on_one ? i : j);
            triangles.push_back(is_on_one ? on_one(from_one + i, from_other + j) : on_other(from_one + i, from_other + j));
        }
        return sum[m][n];
    }

private:
    [[nodiscard]] std::uint8_t one(std::size_t i) const { return one_[i % one_.size()]; }
    [[nodiscard]] std::uint8_t other(std::size_t j) const { return other_[j % other_.size()]; }
    /// On the edge behind corner i or j.
    [[nodiscard]] HitTriangle on_one(std::size_t i, std::size_t j) const { return {one(i), one(i + 1), other(j)}; }
    [[nodiscard]] HitTriangle on_other(std::size_t i, std::size_t j) const { return {other(j + 1), other(j), one(i)}; }
    [[nodiscard]] double area(const HitTriangle& hits) const { return area_of(Corners3{at_[hits[0]], at_[hits[1]], at_[hits[2]]}); }

    std::span<const std::uint8_t> one_;
    std::vector<std::uint8_t> other_;
    const std::array<Vec3, 12>& at_;
    std::array<std::array<bool, 13>, 13> is_on_one_{};  ///< the last triangle of the smallest way to chord (i, j)
};

}  // namespace

std::vector<HitTriangle> tube(std::span<const std::uint8_t> one, std::span<const std::uint8_t> other, const std::array<Vec3, 12>& at) {
    Strips strips(one, {other.rbegin(), other.rend()}, at);
    std::vector<HitTriangle> best, triangles;
    double least = kNever;
    for (std::size_t i = 0; i < one.size(); ++i) {
        for (std::size_t j = 0; j < other.size(); ++j) {
            if (const double area = strips.smallest(i, j, triangles); area < least) least = area, best = triangles;
        }
    }
    return best;
}

}  // namespace isoatlas
