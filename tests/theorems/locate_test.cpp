// What holds a sample, from the trees, against flooding: every voxel at any isovalue.
#include "isoatlas/locate.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "oracle/difference.h"
#include "oracle/stores.h"

namespace oracle {
namespace {

using isoatlas::Locator;
using isoatlas::Volume;

RC_GTEST_FIXTURE_PROP(Stores, LocateTheObjectAndCavityOfEverySample, ()) {
    const Grid grid = *arbitrary_grid(6, 120);
    const isoatlas::Interpolant interpolant = *arbitrary_interpolant();
    const Volume volume = to_volume(grid, arbitrary_type(grid));
    isoatlas::build_atlas(path_, volume, {.interpolant = interpolant});
    const isoatlas::Atlas atlas(path_);
    const Elements elements = elements_of(grid, interpolant);
    const std::vector<double> values = interesting_values(elements);
    std::vector<Locator> holders;
    for (Index v = 0; v < grid.voxels(); ++v) holders.emplace_back(atlas, v);
    for (int i = 0; i < 4; ++i) {
        const double tau = values[*rc::gen::inRange<std::size_t>(0, values.size())];
        const Snapshot snapshot = oracle::snapshot(elements, elements.cut_at(tau));
        for (Index v = 0; v < grid.voxels(); ++v) {
            const Index object = snapshot.object_of[v], low = snapshot.low_of[v];
            const auto held = holders[v].object(tau), cavity = holders[v].cavity(tau);
            RC_ASSERT(held.has_value() == (object >= 0));
            if (held) RC_ASSERT(*held == snapshot.objects[object].highest);
            RC_ASSERT(cavity.has_value() == (low > 0));
            if (cavity) RC_ASSERT(*cavity == snapshot.lows[low].lowest);
        }
    }
}

TEST_F(Stores, LocateNothingOutsideTheVolume) {
    isoatlas::build_atlas(path_, isoatlas::make_volume({.rank = 3, .size = {4, 4, 4}}, isoatlas::ValueType::u8));
    const isoatlas::Atlas atlas(path_);
    EXPECT_THROW(Locator(atlas, -1), isoatlas::Error);
    EXPECT_THROW(Locator(atlas, 64), isoatlas::Error);
    EXPECT_EQ(Locator(atlas, 63).object(0), Locator(atlas, 0).object(0));
    EXPECT_FALSE(Locator(atlas, 21).cavity(0.5));
}

}  // namespace
}  // namespace oracle
