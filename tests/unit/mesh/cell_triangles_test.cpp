// The triangles of every cell case form one disk per loop, embedded wherever the hits lie on their edges.
#include "mesh/cell_triangles.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

#include "oracle/mesh_checks.h"

namespace isoatlas {
namespace {

constexpr SurfaceStyle kStyles[] = {SurfaceStyle::compact, SurfaceStyle::full};

TEST(CellTriangles, FormADiskOverEveryLoop) {
    for (const SurfaceStyle style : kStyles) {
        for (int number = 0; number < kCellCases; ++number) {
            const CellLoops& loops = cell_cases().loops[number];
            const CellTriangles& cell = cell_triangles(style)[number];
            std::map<std::pair<int, int>, int> sides;  // directed
            for (int i = 0; i < cell.triangles; ++i) {
                for (int j = 0; j < 3; ++j) ++sides[{cell.corner[3 * i + j], cell.corner[3 * i + (j + 1) % 3]}];
            }
            std::set<std::pair<int, int>> rim, expected;
            for (const auto& [side, count] : sides) {
                EXPECT_EQ(count, 1);
                if (!sides.contains({side.second, side.first})) rim.insert(side);
            }
            int chi = 0;
            for (int loop = 0; loop < loops.count; ++loop) {
                const int n = loops.size(loop);
                for (int i = 0; i < n; ++i)
                    expected.insert({loops.edge[loops.begin[loop] + i], loops.edge[loops.begin[loop] + (i + 1) % n]});
                chi += n;
            }
            EXPECT_EQ(rim, expected) << number;
            chi += cell.articulation_points + cell.triangles - static_cast<int>(sides.size() + rim.size()) / 2;
            EXPECT_EQ(chi, loops.count) << number;
        }
    }
}

// A chord between two hits of one face could be used by both cells of that face.
TEST(CellTriangles, HaveNoChordInAFace) {
    for (const SurfaceStyle style : kStyles) {
        for (int number = 0; number < kCellCases; ++number) {
            const CellLoops& loops = cell_cases().loops[number];
            const CellTriangles& cell = cell_triangles(style)[number];
            std::set<std::pair<int, int>> links;
            for (int loop = 0; loop < loops.count; ++loop) {
                const int n = loops.size(loop);
                for (int i = 0; i < n; ++i)
                    links.insert(std::minmax<int>(loops.edge[loops.begin[loop] + i], loops.edge[loops.begin[loop] + (i + 1) % n]));
            }
            for (int i = 0; i < 3 * cell.triangles; ++i) {
                const int a = cell.corner[i], b = cell.corner[i % 3 == 2 ? i - 2 : i + 1];
                if (a >= 12 || b >= 12 || links.contains(std::minmax(a, b))) continue;
                EXPECT_FALSE(edges_share_face(a, b)) << number;
            }
        }
    }
}

/// The surface of one cell, hits anywhere between the margins.
Surface cell_surface(int number, SurfaceStyle style, std::mt19937& random) {
    const CellLoops& loops = cell_cases().loops[number];
    const CellTriangles& cell = cell_triangles(style)[number];
    std::uniform_int_distribution<int> kind(0, 2);
    std::uniform_real_distribution<double> inside(0.001, 0.999);
    Surface surface;
    surface.points.assign(16, {0, 0, 0});
    for (int e = 0; e < 12; ++e) {
        const int k = kind(random);
        const double t = k == 0 ? 0.001 : k == 1 ? 0.999 : inside(random);
        for (int a = 0; a < 3; ++a) {
            const int from = kEdgeCorners[e][0] >> a & 1, to = kEdgeCorners[e][1] >> a & 1;
            surface.points[e][a] = from + t * (to - from);
        }
    }
    for (int fan = 0; fan < cell.articulation_points; ++fan) {
        const int loop = cell.articulation_loop[fan];
        for (int i = loops.begin[loop]; i < loops.begin[loop + 1]; ++i) {
            for (int a = 0; a < 3; ++a) surface.points[12 + fan][a] += surface.points[loops.edge[i]][a] / loops.size(loop);
        }
    }
    for (int i = 0; i < cell.triangles; ++i)
        surface.triangles.push_back({cell.corner[3 * i], cell.corner[3 * i + 1], cell.corner[3 * i + 2]});
    return surface;
}

TEST(CellTriangles, NeverCross) {
    std::mt19937 random(7);
    for (const SurfaceStyle style : kStyles) {
        for (int number = 0; number < kCellCases; ++number) {
            for (int trial = 0; trial < 60; ++trial) {
                ASSERT_EQ(oracle::count_crossings(cell_surface(number, style, random)), 0) << "case " << number << " trial " << trial;
            }
        }
    }
}

TEST(CellTriangles, CompactHasFewerTrianglesAndTheDetectorSeesCrossings) {
    std::int64_t compact = 0, full = 0;
    for (int number = 0; number < kCellCases; ++number) {
        compact += cell_triangles(SurfaceStyle::compact)[number].triangles;
        full += cell_triangles(SurfaceStyle::full)[number].triangles;
        EXPECT_LE(cell_triangles(SurfaceStyle::compact)[number].articulation_points,
                  cell_triangles(SurfaceStyle::full)[number].articulation_points);
    }
    EXPECT_LT(compact, full * 3 / 4);
    Surface crossing;
    crossing.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.2, 0.2, -1}, {0.3, 0.2, 1}, {0.2, 0.3, 1}};
    crossing.triangles = {{0, 1, 2}, {3, 4, 5}};
    EXPECT_GT(oracle::count_crossings(crossing), 0);
}

}  // namespace
}  // namespace isoatlas
