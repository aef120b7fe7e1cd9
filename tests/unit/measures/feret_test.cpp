// Feret diameters of hulls: known ones, and random ones against brute force over all directions that can be extreme.
#include "measures/feret.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <numbers>

#include "measures/vectors.h"
#include "oracle/volumes.h"  // number of trials

namespace isoatlas {
namespace {

constexpr double pi = std::numbers::pi;

FeretDiameters of(const std::vector<Vec3>& points, int rank = 3) { return feret_diameters(convex_hull(points, rank), rank); }

double width(const std::vector<Vec3>& points, const Vec3& direction) {
    double low = dot(points[0], direction), high = low;
    for (const Vec3& p : points) low = std::min(low, dot(p, direction)), high = std::max(high, dot(p, direction));
    return (high - low) / norm(direction);
}

TEST(Feret, Cube) {
    std::vector<Vec3> points;
    for (int i = 0; i < 27; ++i) points.push_back({static_cast<double>(i % 3), static_cast<double>(i / 3 % 3), static_cast<double>(i / 9)});
    const FeretDiameters feret = of(points);
    EXPECT_NEAR(feret.max, 2 * std::sqrt(3.0), 1e-12);
    EXPECT_NEAR(feret.min, 2, 1e-12);
    EXPECT_NEAR(feret.mean, 3, 1e-12);
}

TEST(Feret, TetrahedronIsNarrowestBetweenTwoEdges) {
    const FeretDiameters feret = of({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}});
    EXPECT_NEAR(feret.max, 2 * std::sqrt(2.0), 1e-12);
    EXPECT_NEAR(feret.min, 2, 1e-12);
    EXPECT_NEAR(feret.mean, 6 * 2 * std::sqrt(2.0) * (pi - std::acos(1.0 / 3)) / (4 * pi), 1e-12);
}

TEST(Feret, Rectangle) {
    const FeretDiameters feret = of({{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}, {1, 1, 0}}, 2);
    EXPECT_NEAR(feret.max, 5, 1e-12);
    EXPECT_NEAR(feret.min, 3, 1e-12);
    EXPECT_NEAR(feret.mean, 14 / pi, 1e-12);
}

TEST(Feret, TinyAndThinObjectsHaveAWidth) {
    std::vector<Vec3> points;
    for (int i = 0; i < 8; ++i) points.push_back({1000 + 1e-9 * (i % 2), 1e-3 * (i / 2 % 2), 50.0 * (i / 4)});
    const FeretDiameters feret = of(points);
    EXPECT_NEAR(feret.max, 50, 1e-6);
    EXPECT_NEAR(feret.min, 1e-9, 1e-12);
}

TEST(Feret, FlatPointsHaveNoWidth) {
    const FeretDiameters feret = of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    EXPECT_NEAR(feret.max, std::sqrt(2.0), 1e-12);
    EXPECT_TRUE(std::isnan(feret.min));
}

/// Grid points have parallel facets and ties; others have none.
std::vector<Vec3> arbitrary_points(int rank) {
    const bool on_grid = *rc::gen::arbitrary<bool>();
    const auto count = *rc::gen::inRange<std::size_t>(5, 13);
    const std::vector<int> raw = *rc::gen::container<std::vector<int>>(3 * count, rc::gen::resize(100, rc::gen::inRange(0, 10000)));
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < count; ++i) {
        const auto at = [&](std::size_t k) { return on_grid ? raw[3 * i + k] % 4 : raw[3 * i + k] / 1000.0; };
        points.push_back({at(0), at(1), rank == 3 ? at(2) : 0});
    }
    return points;
}

RC_GTEST_PROP(Feret, EqualsBruteForce, ()) {
    const std::vector<Vec3> points = arbitrary_points(3);
    const ConvexHull hull = convex_hull(points, 3);
    std::vector<Vec3> differences;
    double longest = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            differences.push_back(minus(points[i], points[j]));
            longest = std::max(longest, norm(differences.back()));
        }
    }
    constexpr double kNone = 1e9;
    double narrowest = kNone;
    for (const Vec3& p : differences) {
        for (const Vec3& q : differences) {
            const Vec3 across = cross(p, q);
            if (norm(across) > 1e-9) narrowest = std::min(narrowest, width(points, across));
        }
    }
    RC_PRE(narrowest > 1e-6 && narrowest < kNone);  // not flat, nor on a line
    const FeretDiameters feret = feret_diameters(hull, 3);
    RC_ASSERT(std::abs(feret.max - longest) < 1e-12 * longest);
    RC_ASSERT(std::abs(feret.min - narrowest) < 1e-9);
    RC_ASSERT(std::abs(width(points, feret.min_direction) - feret.min) < 1e-9);
    RC_ASSERT(std::abs(width(points, feret.max_direction) - feret.max) < 1e-9);
    double mean = 0;
    constexpr int kDirections = 4000;
    for (int i = 0; i < kDirections; ++i) {
        const double z = 1 - (2 * i + 1.0) / kDirections, angle = i * pi * (3 - std::sqrt(5.0)), r = std::sqrt(1 - z * z);
        mean += width(points, {r * std::cos(angle), r * std::sin(angle), z}) / kDirections;
    }
    RC_ASSERT(std::abs(feret.mean - mean) < 2e-3 * longest);
}

RC_GTEST_PROP(Feret, EqualsBruteForceInThePlane, ()) {
    const std::vector<Vec3> points = arbitrary_points(2);
    double longest = 0, narrowest = 1e9;
    for (const Vec3& p : points) {
        for (const Vec3& q : points) {
            const Vec3 d = minus(p, q);
            longest = std::max(longest, norm(d));
            if (norm(d) > 1e-9) narrowest = std::min(narrowest, width(points, {-d[1], d[0], 0}));
        }
    }
    RC_PRE(narrowest > 1e-6 && narrowest < 1e9);
    const FeretDiameters feret = of(points, 2);
    RC_ASSERT(std::abs(feret.max - longest) < 1e-12 * longest);
    RC_ASSERT(std::abs(feret.min - narrowest) < 1e-9);
}

RC_GTEST_PROP(Hull, OfHullsOfPartsIsThatOfAll, ()) {
    const std::vector<Vec3> points = arbitrary_points(3);
    const std::size_t half = points.size() / 2;
    std::vector<Vec3> left = hull_points(std::span(points).first(half), 3);
    const std::vector<Vec3> right = hull_points(std::span(points).subspan(half), 3);
    left.insert(left.end(), right.begin(), right.end());
    const FeretDiameters whole = of(points), parts = of(left);
    RC_ASSERT(std::abs(whole.max - parts.max) < 1e-12);
    RC_ASSERT(std::isnan(whole.min) == std::isnan(parts.min));
    RC_ASSERT(std::isnan(whole.min) || std::abs(whole.min - parts.min) < 1e-9);
    RC_ASSERT(std::isnan(whole.mean) || std::abs(whole.mean - parts.mean) < 1e-9);
}

}  // namespace
}  // namespace isoatlas
