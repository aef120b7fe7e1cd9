// Where triangles meet, beside CGAL's exact predicates: on a small grid, where nearly all cases are degenerate, and on points that lie in
// planes and on lines of others but for the last bits.
#include "geometry/triangles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "oracle/exact/crossings.h"
#include "oracle/exact/hulls.h"

namespace isoatlas {
namespace {

using Corners = std::array<std::int64_t, 3>;

/// Two triangles that share 0, 1 or 2 of the points 0 to 5; corners in any order.
std::array<Corners, 2> pair_of_triangles(int shared, std::mt19937& random) {
    std::array<Corners, 2> pair{Corners{0, 1, 2}, Corners{3, 4, 5}};
    for (int i = 0; i < shared; ++i) pair[1][i] = i;
    for (Corners& corners : pair) std::ranges::shuffle(corners, random);
    return pair;
}

struct SeenPairs {
    std::array<int, 3> crossing{}, apart{};

    void check(const std::vector<Vec3>& points, int shared, std::mt19937& random) {
        const std::array<Corners, 2> pair = pair_of_triangles(shared, random);
        const oracle::Crossings expected = oracle::find_crossings(points, pair);
        const bool found = triangles_cross<std::int64_t>(points, pair[0], pair[1]);
        ASSERT_EQ(found, triangles_cross<std::int64_t>(points, pair[1], pair[0]));
        if (expected.flat > 0) return;
        ASSERT_EQ(found, expected.crossings > 0) << shared << " shared\n" << expected.first;
        ++(found ? crossing : apart)[shared];
    }
    void expect_all(int count) const {
        for (int shared = 0; shared < 3; ++shared) {
            EXPECT_GT(crossing[shared], count);
            EXPECT_GT(apart[shared], count);
        }
    }
};

std::vector<Vec3> six_points(const auto& point) {
    std::vector<Vec3> points(6);
    for (Vec3& p : points) p = point();
    return points;
}

TEST(Triangles, CrossAsCgalSaysOnASmallGrid) {
    std::mt19937 random(1);
    std::uniform_int_distribution<int> coordinate(0, 3), flat(0, 3);
    SeenPairs seen;
    for (int i = 0; i < 60000; ++i) {
        const int plane = flat(random);
        const auto point = [&] {
            const Vec3 p{double(coordinate(random)), double(coordinate(random)), double(coordinate(random))};
            return plane == 0 ? Vec3{p[0], p[1], p[0] + 2 * p[1]} : p;
        };
        seen.check(six_points(point), i % 3, random);
    }
    seen.expect_all(1000);
}

TEST(Triangles, CrossAsCgalSaysForAnyDoubles) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> coordinate(-1, 1);
    std::uniform_int_distribution<int> flat(0, 2);
    SeenPairs seen;
    for (int i = 0; i < 60000; ++i) {
        const double height = flat(random) == 0 ? 1e-9 : 1;  // with two corners shared only triangles of one plane fold
        const double tilt = coordinate(random);
        const auto point = [&] { return Vec3{coordinate(random), tilt * coordinate(random), height * coordinate(random)}; };
        seen.check(six_points(point), i % 2, random);
    }
    for (int shared = 0; shared < 2; ++shared) {
        EXPECT_GT(seen.crossing[shared], 1000);
        EXPECT_GT(seen.apart[shared], 1000);
    }
}

TEST(Triangles, CrossAsCgalSaysBesideAPlane) {
    std::mt19937 random(3);
    std::uniform_int_distribution<int> coordinate(0, 6), step(-1, 1), plane(0, 1);
    SeenPairs seen;
    for (int i = 0; i < 60000; ++i) {
        const bool in_plane = plane(random) == 0;
        const auto point = [&] {
            Vec3 p{coordinate(random) / 3.0, coordinate(random) / 3.0, 0};
            p[2] = p[0] / 2 + p[1] / 4;
            if (!in_plane)
                for (double& x : p) x = std::nextafter(x, x + step(random));
            return p;
        };
        seen.check(six_points(point), i % 3, random);
    }
    seen.expect_all(200);
}

TEST(Triangles, WithoutAreaMeetAsTheirLongestSide) {
    std::mt19937 random(4);
    std::uniform_int_distribution<int> coordinate(0, 2);
    const auto point = [&] { return Vec3{2.0 * coordinate(random), 2.0 * coordinate(random), 2.0 * coordinate(random)}; };
    int meet = 0;
    for (int i = 0; i < 20000; ++i) {
        const Vec3 p = point(), q = point(), middle{(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2};
        const std::array<Vec3, 3> other{point(), point(), point()};
        const bool expected = segment_meets_triangle(p, q, other);
        ASSERT_EQ(triangles_meet({p, middle, q}, other, 0), expected);
        ASSERT_EQ(triangles_meet(other, {middle, q, p}, 0), expected);
        meet += expected ? 1 : 0;
    }
    EXPECT_GT(meet, 1000);
    EXPECT_LT(meet, 19000);
}

TEST(Triangles, OfTheSameCornersCross) {
    const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    EXPECT_TRUE(triangles_cross<int>(points, {0, 1, 2}, {2, 1, 0}));
}

TEST(Tetrahedron, ContainsWhatItsHullContains) {
    std::mt19937 random(5);
    std::uniform_int_distribution<int> coordinate(0, 3), kind(0, 3), step(-1, 1);
    std::array<int, 2> seen{};
    for (int i = 0; i < 40000; ++i) {
        const int flat = kind(random);
        const auto point = [&] {
            const Vec3 p{double(coordinate(random)), double(coordinate(random)), double(coordinate(random))};
            return flat == 0 ? Vec3{p[0], p[1], p[0] + p[1]} : flat == 1 ? Vec3{p[0], 2 * p[0], 1} : p;
        };
        const std::array<Vec3, 4> corners{point(), point(), point(), point()};
        Vec3 p = point();
        if (i % 2 == 0)
            for (std::size_t k = 0; k < 3; ++k) {
                p[k] = 0.25 * corners[0][k] + 0.75 * corners[i % 4][k];
                p[k] = std::nextafter(p[k], p[k] + step(random));
            }
        const bool expected = oracle::hull_contains(corners, p);
        ASSERT_EQ(tetrahedron_contains(corners, p), expected);
        ++seen[expected ? 1 : 0];
    }
    EXPECT_GT(seen[0], 5000);
    EXPECT_GT(seen[1], 5000);
}

double distance(const Vec3& p, const Vec3& q) { return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]); }

/// By halving in both directions; the distance to a triangle is convex along every line in it.
double searched_distance(const Vec3& p, const std::array<Vec3, 3>& t) {
    const auto at = [&](double v, double w) {
        Vec3 q;
        for (std::size_t i = 0; i < 3; ++i) q[i] = t[0][i] + v * (t[1][i] - t[0][i]) + w * (t[2][i] - t[0][i]);
        return distance(p, q);
    };
    const auto least = [](double end, const auto& of) {
        double low = 0, high = end;
        for (int i = 0; i < 60; ++i) {
            const double first = low + (high - low) / 3, second = high - (high - low) / 3;
            (of(first) < of(second) ? high : low) = of(first) < of(second) ? second : first;
        }
        return std::min({of(low), of(0), of(end)});
    };
    return least(1, [&](double v) { return least(1 - v, [&](double w) { return at(v, w); }); });
}

TEST(NearestPoint, IsOfTheTriangleAndNoOtherIsNearer) {
    std::mt19937 random(6);
    std::uniform_real_distribution<double> coordinate(-1, 1);
    const auto point = [&] { return Vec3{coordinate(random), coordinate(random), coordinate(random)}; };
    for (int i = 0; i < 500; ++i) {
        std::array<Vec3, 3> t{point(), point(), point()};
        if (i % 4 == 0) t[2] = {(t[0][0] + t[1][0]) / 2, (t[0][1] + t[1][1]) / 2, (t[0][2] + t[1][2]) / 2};  // a sliver
        if (i % 8 == 0) t[2][0] += 1e-12;
        if (i % 16 == 0) t[1] = t[2];
        const Vec3 p = point();
        const NearestPoint nearest = nearest_point(p, t);
        ASSERT_NEAR(std::sqrt(nearest.squared_distance), distance(p, nearest.point), 1e-12);
        ASSERT_NEAR(std::sqrt(nearest.squared_distance), searched_distance(p, t), 1e-7);
        ASSERT_NEAR(searched_distance(nearest.point, t), 0, 1e-7);
        ASSERT_DOUBLE_EQ(squared_distance(p, t[0], t[1], t[2]), nearest.squared_distance);
    }
}

}  // namespace
}  // namespace isoatlas
