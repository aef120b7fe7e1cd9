// The bound on how far a star moves is one: no point that is looked at has moved farther along the direction of the star.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "geometry/vectors.h"
#include "level_of_detail/star_deviation.h"

namespace isoatlas {
namespace {

using Triangle = std::array<Vec3, 3>;

/// The edge (gone, kept) among eight points: x and x' beside both, two more beside each.
class RandomStar {
public:
    explicit RandomStar(std::mt19937_64& random) {
        const auto uniform = [&random] { return static_cast<double>(random() >> 11) * 0x1p-52 - 1; };  // -1 to 1
        points_ = {{-0.4, 0, 0.4 * uniform()}, {0.4, 0, 0.4 * uniform()}};
        constexpr double kAngle = 1.0471975511965976;  // 60 degrees
        for (int i = 0; i < 6; ++i) {
            const double angle = -1.5 * kAngle + i * kAngle + 0.3 * uniform(), radius = 1 + 0.3 * uniform();
            points_.push_back({radius * std::cos(angle), radius * std::sin(angle), 0.4 * uniform()});
        }
        new_ = {0.3 * uniform(), 0.3 * uniform(), 0.4 * uniform()};
    }

    /// Of the collapse, by the class that is tested.
    [[nodiscard]] double found() {
        const CollapsibleMesh mesh(kTriangles, points_.size());
        SurfaceState state{.mesh = mesh,
                           .frame = nullptr,
                           .scaled = {},
                           .points = {},
                           .quadrics = {},
                           .faces = {},
                           .locked = {},
                           .failed = {},
                           .distance = {}};
        state.scaled.assign(points_.begin(), points_.end());
        Star star;
        EXPECT_TRUE(star.find(mesh, 0, 1, false));
        star.gone_scaled = points_[0], star.kept_scaled = points_[1], star.new_scaled = new_;
        state.scaled[1] = new_;
        return StarDeviation().find(star, state);
    }

    [[nodiscard]] std::vector<Triangle> before() const {
        return triangles([&](std::size_t i) { return points_[i]; }, false);
    }
    [[nodiscard]] std::vector<Triangle> after() const {
        return triangles([&](std::size_t i) { return i < 2 ? new_ : points_[i]; }, true);
    }

private:
    static constexpr std::array<std::array<std::int64_t, 3>, 8> kTriangles{
        {{1, 2, 3}, {1, 3, 4}, {1, 4, 5}, {0, 5, 6}, {0, 6, 7}, {0, 7, 2}, {0, 1, 5}, {0, 2, 1}}};

    static std::vector<Triangle> triangles(const auto& place, bool is_after) {
        std::vector<Triangle> all;
        for (std::size_t t = 0; t < kTriangles.size() - (is_after ? 2 : 0); ++t) {
            all.push_back({});
            for (std::size_t k = 0; k < 3; ++k) all.back()[k] = place(static_cast<std::size_t>(kTriangles[t][k]));
        }
        return all;
    }

    std::vector<Vec3> points_;
    Vec3 new_{};
};

/// Where the line through p along n meets the triangles, how far from p.
double along(const Vec3& p, const Vec3& n, const std::vector<Triangle>& triangles) {
    for (const auto& [a, b, c] : triangles) {
        const Vec3 ap = minus(a, p), bp = minus(b, p), cp = minus(c, p);
        const double u = dot(n, cross(bp, cp)), v = dot(n, cross(cp, ap)), w = dot(n, cross(ap, bp));
        if (u < 0 || v < 0 || w < 0 || !(u + v + w > 0)) continue;
        return std::abs((u * dot(n, ap) + v * dot(n, bp) + w * dot(n, cp)) / (u + v + w));
    }
    return 0;  // at the ring, for rounding
}

TEST(StarDeviations, BoundWhatMoves) {
    constexpr int kStars = 3000, kSteps = 12;
    std::mt19937_64 random(1);
    int bounded = 0;
    for (int i = 0; i < kStars; ++i) {
        RandomStar star(random);
        const double found = star.found();
        if (!std::isfinite(found)) continue;
        ++bounded;
        const std::vector<Triangle> before = star.before(), after = star.after();
        Vec3 n{};
        for (const auto& [a, b, c] : after) n = plus(n, cross(minus(b, a), minus(c, a)));
        const double length = norm(n);
        for (double& coordinate : n) coordinate /= length;
        double largest = 0;
        for (const auto& [a, b, c] : before) {
            for (int j = 0; j <= kSteps; ++j) {
                for (int k = 0; j + k <= kSteps; ++k) {
                    const double s = static_cast<double>(j) / kSteps, t = static_cast<double>(k) / kSteps;
                    Vec3 p{};
                    for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = (1 - s - t) * a[axis] + s * b[axis] + t * c[axis];
                    largest = std::max(largest, along(p, n, after));
                }
            }
        }
        ASSERT_LE(largest, found + 1e-9) << "star " << i;
    }
    EXPECT_GT(bounded, kStars / 3);
}

}  // namespace
}  // namespace isoatlas
