// Crossings of a whole mesh beside CGAL's, for any number of threads.
#include "geometry/crossings.h"

#include <gtest/gtest.h>

#include "isoatlas/error.h"
#include "oracle/exact/crossings.h"
#include "unit/geometry/meshes.h"

namespace isoatlas {
namespace {

void expect_as_cgal(const TestMesh& mesh, bool crosses) {
    const oracle::Crossings expected = oracle::find_crossings(mesh.points, mesh.triangles);
    ASSERT_EQ(expected.flat, 0);
    ASSERT_EQ(expected.crossings > 0, crosses);
    for (const int threads : {1, 2, 5}) {
        const Crossings found = count_crossings(mesh.points, mesh.triangles, {.threads = threads});
        EXPECT_EQ(found.pairs, expected.crossings);
        ASSERT_EQ(found.first.has_value(), crosses);
        if (crosses) {
            const auto [s, t] = *found.first;
            EXPECT_LT(s, t);
            EXPECT_TRUE(triangles_cross<std::int64_t>(mesh.points, mesh.triangles[s], mesh.triangles[t]));
            for (std::int64_t i = 0; i < s; ++i)
                for (std::int64_t j = i + 1; j < std::int64_t(mesh.triangles.size()); ++j)
                    ASSERT_FALSE(triangles_cross<std::int64_t>(mesh.points, mesh.triangles[i], mesh.triangles[j]));
        }
    }
}

TEST(Crossings, AreThoseOfCgal) {
    std::mt19937 random(1);
    for (const int count : {2, 5, 300, 3000}) expect_as_cgal(soup(random, count, 0.6 / std::cbrt(count)), count > 5);
}

TEST(Crossings, OfASheetAreNone) {
    expect_as_cgal(sheet(40, [](double u, double v) { return u * v; }), false);
    expect_as_cgal(sheet(40, [](double, double) { return 0.0; }), false);
}

TEST(Crossings, OfSheetsThatTouchAreFound) {
    TestMesh mesh = sheet(10, [](double, double) { return 0.0; });
    const TestMesh other = sheet(1, [](double u, double v) { return u + v == 0 ? 0.0 : 1.0; });
    const auto first = static_cast<std::int64_t>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), other.points.begin(), other.points.end());
    for (const TriangleCorners& t : other.triangles) mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    expect_as_cgal(mesh, true);
}

TEST(Crossings, OfNothingAreNone) {
    EXPECT_EQ(count_crossings({}, {}).pairs, 0);
    EXPECT_FALSE(count_crossings({}, {}).first);
}

TEST(Crossings, StopWhenCancelled) {
    const TestMesh mesh = sheet(10, [](double, double) { return 0.0; });
    EXPECT_THROW((void)count_crossings(mesh.points, mesh.triangles, {.cancelled = [] { return true; }}), Error);
}

}  // namespace
}  // namespace isoatlas
