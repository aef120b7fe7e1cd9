// After any sequence of moves a Navigator shows what a fresh query would show, to the last byte.
#include "isoatlas/navigator.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "isoatlas/octree_front.h"
#include "isoatlas/phantom.h"
#include "oracle/stores.h"

namespace oracle {
namespace {

using isoatlas::Atlas;
using isoatlas::Navigator;
using isoatlas::Volume;

class Navigation : public Stores {};

isoatlas::SurfaceOptions arbitrary_options() {
    isoatlas::SurfaceOptions options;
    options.style = *rc::gen::element(isoatlas::SurfaceStyle::compact, isoatlas::SurfaceStyle::full);
    options.boundary = *rc::gen::element(isoatlas::Boundary::closed, isoatlas::Boundary::open);
    options.shell = *rc::gen::element(isoatlas::ShellChoice::all, isoatlas::ShellChoice::all, isoatlas::ShellChoice::inner);
    options.normals = *rc::gen::inRange(0, 3) > 0;
    options.ids = *rc::gen::inRange(0, 2) == 0;
    return options;
}

RC_GTEST_FIXTURE_PROP(Navigation, ShowsWhatAFreshQueryShows, ()) {
    const Grid grid = arbitrary_volume();
    const Volume volume = to_volume(grid, arbitrary_type(grid));
    const isoatlas::ExtractOptions options{.interpolant = *arbitrary_interpolant(), .surface = arbitrary_options()};
    isoatlas::build_atlas(path_, volume, {.interpolant = options.interpolant});
    const Atlas atlas(path_, {.cache_bytes = *rc::gen::element<std::int64_t>(0, 1, 9000, 100000)});
    Navigator navigator(atlas, options.surface);
    const auto [low, high] = atlas.range();
    for (int move = 0; move < 8; ++move) {
        double to = grid.value[*rc::gen::inRange<std::size_t>(0, grid.value.size())];
        if (navigator.tau() && *rc::gen::inRange(0, 2) == 0) to = *navigator.tau() + (high - low) * *rc::gen::inRange(-20, 21) / 200;
        if (*rc::gen::inRange(0, 10) == 0) to = *rc::gen::element(low - 1, low, high, high + 1, -1e300, 1e300);
        if (*rc::gen::inRange(0, 6) == 0) atlas.clear_cache();
        RC_ASSERT(same(navigator.go_to(to, arbitrary_context()), isoatlas::extract(volume, to, options)));
        if (grid.rank == 3 && options.surface.boundary == isoatlas::Boundary::closed && *rc::gen::inRange(0, 3) == 0) {
            const isoatlas::FrontOptions front{.max_level = *rc::gen::inRange(1, 4)};
            const double there = *rc::gen::element(to, low, high);
            const isoatlas::FrontSurface own = navigator.extract_front(there, front, arbitrary_context());
            RC_ASSERT(same(own.surface, isoatlas::extract_front(volume, there, front, options).surface));
            to = there;
        }
        if (*rc::gen::inRange(0, 2) == 0) continue;  // the cost is counted when it is asked for
        isoatlas::QueryCost fresh;
        (void)atlas.extract(to, options.surface, {}, &fresh);
        RC_ASSERT(navigator.cost().cells_active == fresh.cells_active);
    }
}

TEST_F(Navigation, ClassifiesOnlyWhatLiesBetween) {
    const Volume volume = isoatlas::make_phantom("nested-shells", {.size = 96});
    isoatlas::build_atlas(path_, volume);
    const Atlas atlas(path_);
    Navigator navigator(atlas);
    (void)navigator.go_to(0.5);
    EXPECT_EQ(navigator.changed_bricks(), 864);
    const std::int64_t bricks = atlas.reads().bricks;
    (void)navigator.step(0);
    EXPECT_EQ(navigator.changed_bricks(), 0);
    EXPECT_TRUE(same(navigator.step(0.005), isoatlas::extract(volume, 0.505)));
    EXPECT_TRUE(same(navigator.step(-0.005), isoatlas::extract(volume, 0.505 - 0.005)));
    EXPECT_LT(navigator.changed_bricks(), 864);
    EXPECT_LE(atlas.reads().bricks, bricks + 20);
}

TEST_F(Navigation, GoesFromEventToEvent) {
    const Volume volume = isoatlas::make_phantom("nested-shells", {.size = 40, .shells = 2});
    isoatlas::build_atlas(path_, volume);
    const Atlas atlas(path_);
    Navigator navigator(atlas);
    EXPECT_THROW((void)navigator.step(1), isoatlas::Error);
    EXPECT_THROW((void)navigator.to_event_below(), isoatlas::Error);
    (void)navigator.go_to(atlas.range()[1] + 1);
    EXPECT_TRUE(navigator.surface().points.empty());
    EXPECT_FALSE(navigator.to_event_above());
    std::vector<double> down, up;
    while (navigator.to_event_below()) {
        down.push_back(*navigator.tau());
        EXPECT_GT(navigator.changes().events, 0);
        EXPECT_TRUE(same(navigator.surface(), isoatlas::extract(volume, down.back())));
    }
    ASSERT_GT(down.size(), 2U);
    up.push_back(down.back());
    while (navigator.to_event_above()) up.push_back(*navigator.tau());
    EXPECT_EQ(up, std::vector<double>(down.rbegin(), down.rend()));
}

TEST_F(Navigation, FollowsOneObject) {
    const Volume volume = isoatlas::make_phantom("random-field", {.size = 64, .noise = 0.1, .quantise = 64});
    isoatlas::build_atlas(path_, volume);
    const Atlas atlas(path_);
    const isoatlas::ActiveObject start = atlas.active(50).objects.at(1);
    isoatlas::SurfaceOptions options;
    options.objects = {start.id};
    Navigator navigator(atlas, options);
    EXPECT_TRUE(same(navigator.show({start.id}, 50), isoatlas::extract(volume, 50, {.surface = options})));
    ASSERT_TRUE(navigator.to_event_below());
    EXPECT_EQ(*navigator.tau(), start.zone.tau_low);
    EXPECT_TRUE(same(navigator.surface(), isoatlas::extract(volume, start.zone.tau_low, {.surface = options})));
    EXPECT_THROW((void)navigator.go_to(64), isoatlas::Error);  // nothing is that high
    EXPECT_FALSE(navigator.tau());
    EXPECT_TRUE(same(navigator.show({}, 40), isoatlas::extract(volume, 40)));
}

}  // namespace
}  // namespace oracle
