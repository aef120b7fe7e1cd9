// Fewer triangles where they are too many, and the same where they are not.
#include "preview/coarse_surface.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "isoatlas/phantom.h"

namespace isoatlas {
namespace {

TEST(CoarseSurface, HasAtMostSoManyTriangles) {
    const Surface whole = extract(make_phantom("torus-chain", {.size = 32}), 0.5);
    ASSERT_GT(whole.triangles.size(), 2000U);
    for (const std::size_t max : {1000, 100}) {
        const Surface coarse = coarse_surface(whole, max);
        EXPECT_LE(coarse.triangles.size(), max);
        EXPECT_GT(coarse.triangles.size(), max / 8);
        EXPECT_EQ(coarse.points.size(), coarse.normals.size());
        const auto points = static_cast<std::int64_t>(whole.points.size());
        for (const auto& triangle : coarse.triangles) {
            EXPECT_TRUE(std::ranges::all_of(triangle, [&](std::int64_t corner) { return corner >= 0 && corner < points; }));
        }
    }
}

TEST(CoarseSurface, StaysAsItIs) {
    const Surface whole = extract(make_phantom("torus-chain", {.size = 24}), 0.5);
    EXPECT_TRUE(std::ranges::equal(coarse_surface(whole, whole.triangles.size()).triangles, whole.triangles));
    EXPECT_TRUE(coarse_surface(Surface{}, 10).triangles.empty());
}

}  // namespace
}  // namespace isoatlas
