// docs/theory/5-surfaces.md#loops: all 256 patterns x all face resolutions.
#include "field/cell_loops.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <utility>

namespace isoatlas {
namespace {

std::set<int> regions_of(const std::array<std::uint8_t, 8>& region, bool high) {
    std::set<int> found;
    for (const int r : region) {
        if ((r < 8) == high) found.insert(r);
    }
    return found;
}

TEST(CellLoops, AreTheWallsBetweenTheRegionsOfEveryCase) {
    int max = 0;
    for (int number = 0; number < kCellCases; ++number) {
        const int pattern = cell_cases().pattern_of[number], joined = cell_cases().joined_of[number];
        const CellLoops& loops = cell_cases().loops[number];
        const auto region = cell_regions(pattern, joined);
        if (pattern == 0 || pattern == 255) {
            EXPECT_EQ(loops.count, 0);
            continue;
        }
        EXPECT_EQ(loops.count + 1, regions_of(region, true).size() + regions_of(region, false).size()) << pattern << " " << joined;
        max = std::max<int>(max, loops.count);
        std::set<std::pair<int, int>> pairs;
        std::set<int> hits;
        for (int loop = 0; loop < loops.count; ++loop) {
            std::set<std::pair<int, int>> sides;  // every loop separates one High from one Low region, each pair once
            EXPECT_GE(loops.size(loop), 3);
            for (int i = loops.begin[loop]; i < loops.begin[loop + 1]; ++i) {
                std::array<int, 2> ends = kEdgeCorners[loops.edge[i]];
                if ((pattern >> ends[0] & 1) == 0) std::swap(ends[0], ends[1]);
                EXPECT_EQ(pattern >> ends[0] & 1, 1);
                EXPECT_EQ(pattern >> ends[1] & 1, 0);
                sides.insert({region[ends[0]], region[ends[1]]});
                EXPECT_TRUE(hits.insert(loops.edge[i]).second);
            }
            EXPECT_EQ(sides.size(), 1) << pattern << " " << joined;
            EXPECT_TRUE(pairs.insert(*sides.begin()).second);
        }
        int mask = 0;
        for (const int e : hits) mask |= 1 << e;
        EXPECT_EQ(mask, cell_cases().hit_edges[pattern]);
    }
    EXPECT_EQ(max, 4);
}

TEST(CellLoops, JoinedBitsOfOtherFacesDoNotMatter) {
    for (int pattern = 0; pattern < 256; ++pattern) {
        const int split = cell_cases().split_faces[pattern];
        for (int joined = 0; joined < 64; ++joined) {
            const int number = cell_cases().case_of(pattern, joined);
            EXPECT_EQ(cell_cases().pattern_of[number], pattern);
            EXPECT_EQ(cell_cases().joined_of[number], joined & split);
        }
    }
}

// Neighbouring cells see the same links on their common face, the other way round: that closes and orients the surface.
TEST(CellLoops, NeighboursAgreeOnTheirCommonFace) {
    for (int corners = 0; corners < 16; ++corners) {
        for (int orientation = 0; orientation < 3; ++orientation) {
            const int near = 2 * orientation, far = near + 1;
            int pattern_far = 0, pattern_near = 0;
            for (int i = 0; i < 4; ++i) {
                pattern_far |= (corners >> i & 1) << kFaceCorners[far][i];
                pattern_near |= (corners >> i & 1) << kFaceCorners[near][i];
            }
            for (const int joined : {0, 63}) {
                const FaceLinks a = face_links(pattern_far, joined, far), b = face_links(pattern_near, joined, near);
                ASSERT_EQ(a.count, b.count);
                const auto moved = [&](int edge) {  // the edge of the far face that is this edge of the near face
                    const int bit = 1 << kFaceAxes[orientation].normal;
                    return edge_between(kEdgeCorners[edge][0] | bit, kEdgeCorners[edge][1] | bit);
                };
                std::set<std::pair<int, int>> links, reversed;
                for (int i = 0; i < a.count; ++i) {
                    links.insert({a.link[i][0], a.link[i][1]});
                    reversed.insert({moved(b.link[i][1]), moved(b.link[i][0])});
                }
                EXPECT_EQ(links, reversed);
            }
        }
    }
}

// One High corner: the loop around it is counter-clockwise seen from outside that corner, where the Lows are.
TEST(CellLoops, TurnCounterClockwiseSeenFromTheLows) {
    for (int corner = 0; corner < 8; ++corner) {
        const CellLoops& loops = cell_loops(1 << corner, 0);
        ASSERT_EQ(loops.count, 1);
        ASSERT_EQ(loops.size(0), 3);
        std::array<std::array<double, 3>, 3> point{};
        for (int i = 0; i < 3; ++i) {
            for (int a = 0; a < 3; ++a)
                point[i][a] = ((kEdgeCorners[loops.edge[i]][0] >> a & 1) + (kEdgeCorners[loops.edge[i]][1] >> a & 1)) / 2.0;
        }
        double facing = 0;  // of the normal, along the diagonal from the corner into the cell
        for (int a = 0; a < 3; ++a) {
            const int b = (a + 1) % 3, c = (a + 2) % 3;
            const double normal =
                (point[1][b] - point[0][b]) * (point[2][c] - point[0][c]) - (point[1][c] - point[0][c]) * (point[2][b] - point[0][b]);
            facing += normal * ((corner >> a & 1) != 0 ? -1 : 1);
        }
        EXPECT_GT(facing, 0) << corner;
    }
}

}  // namespace
}  // namespace isoatlas
