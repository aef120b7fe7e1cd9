// The engine equals the brute-force oracle on random small volumes, piece by piece.
#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "oracle/bodies.h"
#include "oracle/compare.h"
#include "oracle/flooding.h"
#include "oracle/volumes.h"

namespace oracle {
namespace {

struct Both {
    Elements elements;
    Result expected;
    isoatlas::Analysis actual;
    explicit Both(const Grid& grid, const isoatlas::Context& context = {}) : Both(grid, *arbitrary_interpolant(), context) {}
    Both(const Grid& grid, isoatlas::Interpolant interpolant, const isoatlas::Context& context)
        : elements(elements_of(grid, interpolant)),
          expected(analyse(elements)),
          actual(isoatlas::analyse(to_volume(grid), {.interpolant = interpolant}, context)) {
        RC_ASSERT(expected.consistent);
    }
};

isoatlas::Context odd_context() {
    isoatlas::Context context;
    context.threads = *rc::gen::inRange(1, 4);
    context.slab_slices = *rc::gen::inRange(1, 4);
    return context;
}

#define EXPECT_SAME(text)                    \
    do {                                     \
        const std::string difference = text; \
        RC_ASSERT(difference == "");         \
    } while (false)

void engine_finds_the_elements_of_the_oracle() {
    const Both both(*arbitrary_grid(), odd_context());
    EXPECT_SAME(compare_elements(both.expected, both.actual));
}

void engine_finds_the_contour_arcs_and_genera_of_the_oracle() {
    const Both both(*arbitrary_grid(), odd_context());
    EXPECT_SAME(compare_arcs(both.expected, both.actual));
}

void engine_finds_the_levels_of_the_oracle() {
    const Both both(*arbitrary_grid());
    EXPECT_SAME(compare_levels(both.expected, both.actual));
}

// Value, position, kind, parent, children, lows, chi, b1, b2, contour genera, zone interval and voxels of every event.
void engine_finds_the_events_of_the_oracle() {
    const Both both(*arbitrary_grid());
    EXPECT_SAME(compare_events(both.expected, both.actual));
}

void engine_finds_the_zone_of_every_voxel() {
    const Both both(*arbitrary_grid(), odd_context());
    EXPECT_SAME(compare_zones(both.expected, both.actual));
}

void engine_finds_everything_in_larger_volumes() {
    if (*rc::gen::inRange(0, 5) != 0) return;  // a fifth of the trials: each costs as much as ten small ones
    const Both both(*arbitrary_grid(7, 343), odd_context());
    EXPECT_SAME(compare(both.expected, both.actual));
}

void engine_finds_the_flooding_tree_without_ties() {
    const Both both(without_ties(*arbitrary_grid()));
    if (has_ties(both.elements)) return;
    const Flooding flooding = flood(both.elements, both.expected.critical);
    RC_ASSERT(both.actual.event_count() == static_cast<Index>(flooding.parent.size()));
    for (const isoatlas::EventId e : isoatlas::ids<isoatlas::EventId>(both.actual.event_count()))
        RC_ASSERT(both.actual.event(e).parent.number() == flooding.parent[e.index()]);
    for (Index v = 0; v < both.elements.grid.voxels(); ++v) RC_ASSERT(both.actual.zone(isoatlas::VoxelId(v)).number() == flooding.label[v]);
}

void engine_finds_the_same_in_mirrored_and_transposed_volumes() {
    const Grid grid = *arbitrary_grid(7, 120);
    isoatlas::Context context;
    context.threads = 1;
    const isoatlas::AnalysisOptions options{.interpolant = *arbitrary_interpolant()};
    const std::string expected = canonical_text(isoatlas::analyse(to_volume(grid), options, context));
    for (int trial = 0; trial < 4; ++trial) {
        const auto [order, mirror] = *rc::gen::elementOf(turns(grid.rank));
        RC_ASSERT(canonical_text(isoatlas::analyse(to_volume(rotated(grid, order, mirror)), options, context)) == expected);
    }
}

TEST(Engine, TakesNegativeZeroForZero) {
    for (const isoatlas::Interpolant interpolant : {isoatlas::Interpolant::faces, isoatlas::Interpolant::trilinear}) {
        const Grid grid{3, {3, 3, 2}, {-0.0, 0.0, -1, 1, -0.0, 1, 0.0, -1, -0.0, 1, -0.0, 0.0, -0.0, 1, -1, -0.0, 1, 0.0}};
        const isoatlas::Analysis analysis = isoatlas::analyse(to_volume(grid), {.interpolant = interpolant});
        int zeros = 0;
        for (const isoatlas::ElementId i : isoatlas::ids<isoatlas::ElementId>(analysis.element_count())) {
            const double value = analysis.element(i).value;
            zeros += value == 0;
            EXPECT_FALSE(value == 0 && std::signbit(value));
        }
        EXPECT_GT(zeros, 0);
    }
}

void engine_finds_the_same_trees_without_zones() {
    const Grid grid = *arbitrary_grid();
    const isoatlas::AnalysisOptions options{.interpolant = *arbitrary_interpolant(), .zones = false};
    const isoatlas::Analysis bare = isoatlas::analyse(to_volume(grid), options);
    const Result expected = analyse(elements_of(grid, options.interpolant));
    EXPECT_SAME(compare_elements(expected, bare));
    EXPECT_SAME(compare_levels(expected, bare));
    RC_ASSERT(bare.event_count() == static_cast<Index>(expected.events.size()));
    RC_ASSERT_THROWS_AS(static_cast<void>(bare.zone(isoatlas::VoxelId(0))), isoatlas::Error);
}

RC_GTEST_PROP(Engine, FindsTheElementsOfTheOracle, ()) { engine_finds_the_elements_of_the_oracle(); }
RC_GTEST_PROP(Engine, FindsTheContourArcsAndGeneraOfTheOracle, ()) { engine_finds_the_contour_arcs_and_genera_of_the_oracle(); }
RC_GTEST_PROP(Engine, FindsTheLevelsOfTheOracle, ()) { engine_finds_the_levels_of_the_oracle(); }
RC_GTEST_PROP(Engine, FindsTheEventsOfTheOracle, ()) { engine_finds_the_events_of_the_oracle(); }
RC_GTEST_PROP(Engine, FindsTheZoneOfEveryVoxel, ()) { engine_finds_the_zone_of_every_voxel(); }
RC_GTEST_PROP(Engine, FindsEverythingInLargerVolumes, ()) { engine_finds_everything_in_larger_volumes(); }
RC_GTEST_PROP(Engine, FindsTheFloodingTreeWithoutTies, ()) { engine_finds_the_flooding_tree_without_ties(); }
RC_GTEST_PROP(Engine, FindsTheSameLevelsAndEventsInMirroredVolumes, ()) { engine_finds_the_same_in_mirrored_and_transposed_volumes(); }
RC_GTEST_PROP(Engine, FindsTheSameTreesWithoutZones, ()) { engine_finds_the_same_trees_without_zones(); }

}  // namespace
}  // namespace oracle
