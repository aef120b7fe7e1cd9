// A grown region touches the bricks of all Highs that chains of neighbours join with its seeds, and those beside them, and asks for no
// others.
#include "bricks/region_growing.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "arbitrary_scene.h"

namespace isoatlas {
namespace {

RC_GTEST_PROP(RegionGrowing, TouchesTheBricksOfTheRegionAndThoseBesideIt, ()) {
    const Scene scene = arbitrary_scene();
    const BrickGrid& grid = scene.grid;
    IdArray<BrickId, BrickClass> classes(static_cast<std::size_t>(grid.count()));
    for (const BrickId b : grid.bricks()) classes[b] = scene.class_of(b);
    std::vector<Index3> seeds;
    for (const std::int64_t voxel : *rc::gen::container<std::vector<std::int64_t>>(rc::gen::inRange<std::int64_t>(0, grid.extent.voxels())))
        seeds.push_back(grid.extent.voxel(voxel));
    if (seeds.size() > 3) seeds.resize(3);

    RegionGrowing region(grid, classes);
    for (const Index3& seed : seeds) region.seed(seed);
    const std::int64_t together = *rc::gen::inRange<std::int64_t>(0, 12);
    BrickFlags read(classes.size(), 0);
    for (std::vector<BrickId> missing = region.grow(); !missing.empty(); missing = region.grow()) {
        const std::size_t touched = missing.size();
        region.extend(missing, together);
        RC_ASSERT(missing.size() >= touched);
        RC_ASSERT(std::ranges::is_sorted(missing));
        for (const BrickId b : missing) {
            RC_ASSERT(classes[b] == BrickClass::divided);
            RC_ASSERT(read[b] == 0);
            read[b] = 1;
            region.add(b, scene.bits(b));
        }
    }
    const BrickFlags expected = oracle::bricks_of_region(scene, seeds);
    RC_ASSERT(region.touched() == expected);
    for (const BrickId b : grid.bricks()) RC_ASSERT(!(expected[b] && classes[b] == BrickClass::divided) || read[b]);
}

}  // namespace
}  // namespace isoatlas
