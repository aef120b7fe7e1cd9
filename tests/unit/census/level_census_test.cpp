// The census knows at every isovalue how many samples, hits and active cells a cut finds, or bounds them.
#include "census/level_census.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "oracle/mesh_checks.h"

namespace oracle {
namespace {

using isoatlas::Bounds;

bool lies_in(Index number, const Bounds& bounds) { return bounds.min <= number && number <= bounds.max; }

RC_GTEST_PROP(Census, BoundsWhatACutFinds, ()) {
    const Grid grid = *arbitrary_grid(9, 400);
    const isoatlas::Volume volume = to_volume(grid, arbitrary_type(grid));
    const bool whole = !isoatlas::is_floating(volume.info.type);
    const isoatlas::LevelCensus census = isoatlas::take_census(volume, arbitrary_context());
    for (const double tau : interesting_values(elements_of(grid, isoatlas::Interpolant::faces))) {
        const isoatlas::Cut cut = isoatlas::cut(volume, tau);
        Index voxels = 0, hits = 0;
        for (const auto& object : cut.objects) voxels += object.voxels;
        for (const auto& contour : cut.contours) hits += contour.hits;
        const auto counts = census.at(tau, whole);
        RC_ASSERT(lies_in(voxels, counts.samples));
        RC_ASSERT(lies_in(hits, counts.hits));
        RC_ASSERT(lies_in(cut.active_cells, counts.cells));
        const bool all_values = whole && census.value.back() - census.value.front() == static_cast<double>(census.value.size() - 1);
        if (!all_values && !std::binary_search(census.value.begin(), census.value.end(), tau)) continue;
        RC_ASSERT(counts.samples.min == counts.samples.max);
        RC_ASSERT(counts.hits.min == counts.hits.max);
        RC_ASSERT(counts.cells.min == counts.cells.max);
    }
}

TEST(Census, HoldsAtTheEndsOfEveryType) {
    const auto check = [](std::vector<double> values) {
        const isoatlas::Volume volume = isoatlas::make_volume<double>({3, {3, 1, 1}}, values);
        const isoatlas::LevelCensus census = isoatlas::take_census(volume, {});
        EXPECT_EQ(census.value.front(), *std::min_element(values.begin(), values.end()));
        EXPECT_EQ(census.value.back(), *std::max_element(values.begin(), values.end()));
        EXPECT_EQ(census.samples.front(), 3U);
        EXPECT_EQ(census.at(census.value.back(), false).samples.max, 1);
    };
    check({-1.7e308, 0, 1.7e308});
    check({1, std::nextafter(1.0, 2.0), 0.5});
    check({-5e-324, 0, 5e-324});
}

}  // namespace
}  // namespace oracle
