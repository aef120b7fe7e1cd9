// Distances between meshes beside brute force: the bounds hold for every point of a fine grid on each triangle, and the point that is named
// is so far away.
#include "geometry/deviation.h"

#include <gtest/gtest.h>

#include "isoatlas/error.h"
#include "unit/geometry/meshes.h"

namespace isoatlas {
namespace {

double brute_distance(const Vec3& p, const MeshView& mesh) {
    double least = std::numeric_limits<double>::infinity();
    for (const TriangleCorners& t : mesh.triangles)
        least = std::min(least, squared_distance(p, mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]));
    return std::sqrt(least);
}

struct Sampled {
    double max = 0, spacing = 0;  ///< no point of a triangle is farther from a sample than the spacing
};

Sampled sample(const MeshView& mesh, const MeshView& other, int steps) {
    Sampled result;
    for (const TriangleCorners& t : mesh.triangles) {
        const Vec3 &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
        for (int i = 0; i <= steps; ++i)
            for (int j = 0; i + j <= steps; ++j) {
                Vec3 p;
                for (std::size_t k = 0; k < 3; ++k) p[k] = a[k] + i * (b[k] - a[k]) / steps + j * (c[k] - a[k]) / steps;
                result.max = std::max(result.max, brute_distance(p, other));
            }
        for (const auto& [p, q] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
            result.spacing = std::max(result.spacing, std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]) / steps);
    }
    return result;
}

void expect_encloses(const OneSidedDistance& found, const MeshView& mesh, const MeshView& other, double tolerance) {
    const Sampled sampled = sample(mesh, other, 12);
    EXPECT_LE(found.lower, found.upper);
    EXPECT_LE(found.upper, found.lower + tolerance + 1e-12);
    EXPECT_GE(found.upper, sampled.max - 1e-12);
    EXPECT_LE(found.lower, sampled.max + sampled.spacing);
    ASSERT_GE(found.triangle, 0);
    EXPECT_NEAR(brute_distance(found.place, other), found.lower, 1e-12);
    const TriangleCorners& t = mesh.triangles[found.triangle];
    EXPECT_NEAR(squared_distance(found.place, mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]), 0, 1e-20);
}

void expect_encloses(const TestMesh& first, const TestMesh& second, double tolerance) {
    const Deviation one = measure_deviation(first.view(), second.view(), {.tolerance = tolerance}, {.threads = 1});
    expect_encloses(one.first_to_second, first.view(), second.view(), tolerance);
    expect_encloses(one.second_to_first, second.view(), first.view(), tolerance);
    const Deviation three = measure_deviation(first.view(), second.view(), {.tolerance = tolerance}, {.threads = 3});
    EXPECT_EQ(one.first_to_second.lower, three.first_to_second.lower);
    EXPECT_EQ(one.first_to_second.upper, three.first_to_second.upper);
    EXPECT_EQ(one.first_to_second.place, three.first_to_second.place);
    EXPECT_EQ(one.second_to_first.triangle, three.second_to_first.triangle);
}

TEST(TriangleTree, FindsTheNearest) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> coordinate(-1, 2);
    for (const int count : {1, 3, 4, 5, 100, 1000}) {
        const TestMesh mesh = soup(random, count, 0.1);
        const TriangleTree tree(mesh.points, mesh.triangles, 2);
        for (int i = 0; i < 200; ++i) {
            const Vec3 p{coordinate(random), coordinate(random), coordinate(random)};
            const NearTriangle near = tree.nearest(p);
            ASSERT_DOUBLE_EQ(std::sqrt(near.nearest.squared_distance), brute_distance(p, mesh.view()));
            const NearTriangle guessed = tree.nearest(p, tree.near(p, count / 2));
            ASSERT_EQ(guessed.nearest.squared_distance, near.nearest.squared_distance);
        }
    }
}

TEST(Deviation, EnclosesThatOfSoups) {
    std::mt19937 random(2);
    for (int i = 0; i < 12; ++i) expect_encloses(soup(random, 20, 0.3), soup(random, 5 + 10 * i, 0.3), i % 2 == 0 ? 1e-2 : 1e-4);
}

TEST(Deviation, EnclosesThatOfSheets) {
    const auto wave = [](double u, double v) { return 0.1 * std::sin(7 * u) * std::cos(5 * v); };
    const auto flat = [](double, double) { return 0.0; };
    expect_encloses(sheet(12, wave), sheet(3, wave), 1e-3);
    expect_encloses(sheet(12, wave), sheet(12, flat), 1e-3);
    expect_encloses(sheet(9, flat), sheet(4, flat), 1e-3);
}

TEST(Deviation, IsZeroOfTheSameSurfaceInOtherTriangles) {
    const auto plane = [](double u, double v) { return u / 2 + v / 4; };
    const Deviation found = measure_deviation(sheet(16, plane).view(), sheet(4, plane).view(), {.tolerance = 1e-6});
    EXPECT_EQ(found.lower(), 0);
    EXPECT_LE(found.upper(), 1e-6);
}

TEST(Deviation, IsFoundBetweenThePoints) {
    TestMesh roof, floor;  // all points of the roof's rim are on the floor, which has no point below the ridge
    roof.points = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {2, 2, 0}, {1, 0, 1}, {1, 2, 1}};
    roof.triangles = {{0, 4, 5}, {0, 5, 2}, {4, 1, 3}, {4, 3, 5}};
    floor.points = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {2, 2, 0}};
    floor.triangles = {{0, 1, 3}, {0, 3, 2}};
    const Deviation found = measure_deviation(floor.view(), roof.view(), {.tolerance = 1e-9});
    EXPECT_NEAR(found.first_to_second.lower, std::sqrt(0.5), 1e-8);  // of the middle of the floor, to the slopes
    EXPECT_NEAR(found.second_to_first.lower, 1, 1e-8);
    EXPECT_NEAR(found.first_to_second.place[0], 1, 1e-6);
}

TEST(Deviation, DecidesALimitThatIsNearlyReached) {
    const auto flat = [](double, double) { return 0.0; };
    const auto lifted = [](double u, double) { return 0.5 - 1e-5 + 0.001 * (u - 1); };
    const MeshView first = MeshView{}, second = first;
    const TestMesh low = sheet(5, flat), high = sheet(7, lifted);
    const Deviation found = measure_deviation(low.view(), high.view(), {.tolerance = 0.1, .limit = 0.5});
    EXPECT_LE(found.upper(), 0.5);
    EXPECT_EQ(measure_deviation(first, second).upper(), 0);
}

TEST(Deviation, EndsWhereAllIsAsFarAsTheLimit) {
    TestMesh inner, outer;  // half a unit apart everywhere, but for rounding
    constexpr int kSides = 40;
    for (int ring = 0; ring <= kSides; ++ring)
        for (int i = 0; i < kSides; ++i) {
            const double turn = 2 * std::acos(-1.0) * i / kSides, height = 2.0 * ring / kSides;
            inner.points.push_back({std::cos(turn), std::sin(turn), height});
            outer.points.push_back({1.5 * std::cos(turn), 1.5 * std::sin(turn), height});
            if (ring == kSides) continue;
            const std::int64_t a = ring * kSides + i, b = ring * kSides + (i + 1) % kSides, c = a + kSides, d = b + kSides;
            for (const TriangleCorners& t : {TriangleCorners{a, b, d}, TriangleCorners{a, d, c}})
                inner.triangles.push_back(t), outer.triangles.push_back(t);
        }
    const Deviation found = measure_deviation(inner.view(), outer.view(), {.tolerance = 1e-2, .limit = 0.5});
    EXPECT_NEAR(found.lower(), 0.5, 1e-9);
    EXPECT_LE(found.upper(), 0.51);
}

TEST(Deviation, FromNothingIsInfinite) {
    const TestMesh some = sheet(1, [](double, double) { return 0.0; });
    const Deviation found = measure_deviation(some.view(), MeshView{});
    EXPECT_EQ(found.first_to_second.lower, std::numeric_limits<double>::infinity());
    EXPECT_EQ(found.second_to_first.upper, 0);
    EXPECT_THROW((void)measure_deviation(some.view(), some.view(), {.tolerance = 0}), Error);
    EXPECT_THROW((void)measure_deviation(some.view(), some.view(), {}, {.cancelled = [] { return true; }}), Error);
}

}  // namespace
}  // namespace isoatlas
