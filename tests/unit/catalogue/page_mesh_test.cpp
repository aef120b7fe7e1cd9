// Surfaces inside a page keep within their bytes, and say what they keep of the topology.
#include "catalogue/page_mesh.h"

#include <gtest/gtest.h>

#include "isoatlas/phantom.h"

namespace isoatlas {
namespace {

TEST(PageMesh, KeepsWithinItsBytes) {
    const Surface surface = extract(make_phantom("gyroid", {.size = 64}), 0);
    const CoarseSurface coarse = coarse_for_page(surface, {});
    EXPECT_TRUE(coarse.keeps_topology);
    EXPECT_EQ(coarse.of, std::ssize(surface.triangles));
    for (const std::int64_t max : {200'000, 60'000, 20'000, 5'000}) {
        SCOPED_TRACE(max);
        const PageMesh mesh = page_mesh(coarse, max, {});
        EXPECT_LE(std::ssize(mesh.data), max);
        EXPECT_GT(std::ssize(mesh.data), max / 4);
        EXPECT_EQ(mesh.of, coarse.of);
        EXPECT_LE(mesh.triangles, static_cast<std::int64_t>(kMaxPageTriangles));
    }
    EXPECT_TRUE(page_mesh(coarse, 1000, {}).data.empty());
    EXPECT_TRUE(page_mesh(coarse, -5, {}).data.empty());
    EXPECT_TRUE(page_mesh({}, 100'000, {}).data.empty());
}

/// Every cell of it has a tunnel: so few triangles cannot have them all.
TEST(PageMesh, SaysThatTheTopologyDiffers) {
    const Surface surface = extract(make_phantom("noise", {.size = 24}), 0.5);
    const CoarseSurface coarse = coarse_for_page(surface, {});
    ASSERT_GT(coarse.of, 40'000);
    const PageMesh mesh = page_mesh(coarse, 8000, {});
    ASSERT_FALSE(mesh.data.empty());
    EXPECT_FALSE(mesh.keeps_topology);
}

}  // namespace
}  // namespace isoatlas
