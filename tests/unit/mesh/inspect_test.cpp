#include <gtest/gtest.h>

#include <limits>

#include "isoatlas/surface.h"

namespace isoatlas {
namespace {

using Points = std::vector<Vec3>;
using Triangles = std::vector<std::array<std::int64_t, 3>>;

const Points kCorners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const Triangles kTetrahedron{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

/// Tetrahedra that share their first `shared` points.
std::pair<Points, Triangles> two_tetrahedra(std::int64_t shared) {
    Points points = kCorners;
    Triangles triangles = kTetrahedron;
    for (std::size_t i = static_cast<std::size_t>(shared); i < 4; ++i)
        points.push_back({-kCorners[i][0] - 3, -kCorners[i][1] - 3, -kCorners[i][2] - 3});
    for (auto t : kTetrahedron) {
        for (std::int64_t& p : t) p = p < shared ? p : p + 4 - shared;
        triangles.push_back(t);
    }
    return {points, triangles};
}

TEST(Inspect, ATetrahedronIsASphere) {
    const SurfaceReport report = inspect(kCorners, kTetrahedron);
    EXPECT_EQ(report.points, 4);
    EXPECT_EQ(report.triangles, 4);
    EXPECT_EQ(report.edges, 6);
    EXPECT_TRUE(report.is_closed() && report.is_manifold() && report.is_oriented() && report.has_no_zero_area());
    EXPECT_EQ(report.unused_points, 0);
    EXPECT_EQ(report.coincident_points, 0);
    EXPECT_EQ(report.component_chi, (std::vector<std::int64_t>{2}));
}

TEST(Inspect, AMissingTriangleOpensThreeEdges) {
    const SurfaceReport report = inspect(kCorners, Triangles(kTetrahedron.begin(), kTetrahedron.end() - 1));
    EXPECT_EQ(report.boundary_edges, 3);
    EXPECT_FALSE(report.is_closed());
    EXPECT_TRUE(report.is_manifold());
    EXPECT_EQ(report.component_chi, (std::vector<std::int64_t>{1}));
}

TEST(Inspect, TwoShellsThatShareAPoint) {
    const auto [points, triangles] = two_tetrahedra(1);
    const SurfaceReport report = inspect(points, triangles);
    EXPECT_EQ(report.non_manifold_points, 1);
    EXPECT_EQ(report.non_manifold_edges, 0);
    EXPECT_TRUE(report.is_closed());
    EXPECT_FALSE(report.is_manifold());
    EXPECT_EQ(report.component_chi, (std::vector<std::int64_t>{3}));
}

TEST(Inspect, TwoShellsThatShareAnEdge) {
    const auto [points, triangles] = two_tetrahedra(2);
    const SurfaceReport report = inspect(points, triangles);
    EXPECT_EQ(report.non_manifold_edges, 1);
    EXPECT_EQ(report.non_manifold_points, 2);
    EXPECT_FALSE(report.is_closed());
}

TEST(Inspect, SeparateShellsInOrderOfTheirFirstPoint) {
    auto [points, triangles] = two_tetrahedra(0);
    triangles.pop_back();
    const SurfaceReport report = inspect(points, triangles);
    EXPECT_EQ(report.component_chi, (std::vector<std::int64_t>{2, 1}));
}

TEST(Inspect, ATurnedTriangle) {
    Triangles triangles = kTetrahedron;
    std::swap(triangles[2][0], triangles[2][1]);
    const SurfaceReport report = inspect(kCorners, triangles);
    EXPECT_EQ(report.misoriented_edges, 3);
    EXPECT_TRUE(report.is_closed());
    EXPECT_FALSE(report.is_oriented());
}

TEST(Inspect, TwoFansOfOneOpenPointAreNotManifold) {
    const Points points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}};
    const SurfaceReport report = inspect(points, Triangles{{0, 1, 2}, {0, 3, 4}});
    EXPECT_EQ(report.non_manifold_points, 1);
    EXPECT_EQ(report.boundary_edges, 6);
}

TEST(Inspect, ZeroArea) {
    const Points points{{0, 0, 0}, {1, 1, 1}, {3, 3, 3}, {1, 1, 1}, {0, 1, 0}};
    EXPECT_EQ(inspect(points, Triangles{{0, 1, 2}}).zero_area_triangles, 1);  // collinear
    EXPECT_EQ(inspect(points, Triangles{{1, 3, 4}}).zero_area_triangles, 1);  // equal coordinates
    EXPECT_EQ(inspect(points, Triangles{{0, 0, 4}}).zero_area_triangles, 1);  // one point twice
    EXPECT_EQ(inspect(points, Triangles{{0, 1, 4}}).zero_area_triangles, 0);
}

TEST(Inspect, UnusedAndCoincidentPoints) {
    const Points points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0, 0, 0}, {0, 0, 0}};
    const SurfaceReport report = inspect(points, Triangles{{0, 1, 2}});
    EXPECT_EQ(report.unused_points, 2);
    EXPECT_EQ(report.coincident_points, 2);
    EXPECT_EQ(report.component_chi, (std::vector<std::int64_t>{1}));
}

TEST(Inspect, NothingAtAll) {
    const SurfaceReport report = inspect(Points{}, Triangles{});
    EXPECT_TRUE(report.is_closed() && report.is_manifold());
    EXPECT_TRUE(report.component_chi.empty());
}

TEST(Inspect, AnIndexThatIsNoPointIsRefused) {
    for (const std::int64_t bad : {std::int64_t{4}, std::int64_t{-1}, std::numeric_limits<std::int64_t>::max()}) {
        try {
            static_cast<void>(inspect(kCorners, Triangles{{0, 1, 2}, {0, 1, bad}}));
            FAIL() << bad;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::input);
            EXPECT_EQ(error.text().where, "triangle 1");
        }
    }
}

}  // namespace
}  // namespace isoatlas
