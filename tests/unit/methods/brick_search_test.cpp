// The bricks of a store hold the active cells; what is read is counted, each query as a first one.
#include "isoatlas/brick_search.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>

#include "isoatlas/phantom.h"
#include "oracle/stores.h"

namespace oracle {
namespace {

using isoatlas::BrickSearch;
using isoatlas::CellId;
using isoatlas::CellSearchCost;

class Bricks : public Stores {};

std::vector<CellId> expected(const isoatlas::Volume& volume, double tau) {
    CellSearchCost cost;
    return isoatlas::make_cell_search(isoatlas::SearchMethod::brute_force, volume)->active(tau, cost);
}

RC_GTEST_FIXTURE_PROP(Bricks, FindTheActiveCells, ()) {
    const Grid grid = arbitrary_volume();
    const isoatlas::Volume volume = to_volume(grid, arbitrary_type(grid));
    isoatlas::build_atlas(path_, volume);
    BrickSearch search(path_);
    const auto values = std::minmax_element(grid.value.begin(), grid.value.end());
    for (const double tau :
         {*values.first, (*values.first + *values.second) / 2, grid.value[grid.value.size() / 2], *values.second, *values.second + 1}) {
        CellSearchCost cost;
        RC_ASSERT(search.active(tau, cost) == expected(volume, tau));
        RC_ASSERT(cost.active <= cost.cells);
    }
}

TEST_F(Bricks, OfLowValuesAreThoseOfTheNegatedVolume) {
    const isoatlas::Volume low = isoatlas::negated(isoatlas::make_phantom("random-field", {.size = 24}));
    isoatlas::build_atlas(path_, low);
    BrickSearch search(path_);
    CellSearchCost cost;
    for (const double tau : {-1.0, 0.0, 1.5}) EXPECT_EQ(search.active(tau, cost), expected(low, tau));
}

TEST_F(Bricks, ReadThoseThatTheIsovalueDividesAgainEachTime) {
    const isoatlas::Volume volume = isoatlas::make_phantom("random-field", {.size = 64});
    isoatlas::build_atlas(path_, volume);
    BrickSearch search(path_);
    CellSearchCost few, again, none, many;
    EXPECT_EQ(search.active(2.5, few), expected(volume, 2.5));
    EXPECT_EQ(search.active(0, many), expected(volume, 0));
    EXPECT_EQ(search.active(2.5, again), expected(volume, 2.5));
    EXPECT_EQ(few.blocks, again.blocks);
    EXPECT_EQ(few.bytes_read, again.bytes_read);
    EXPECT_LT(few.blocks, many.blocks);
    EXPECT_TRUE(search.active(1e6, none).empty());
    EXPECT_EQ(none.bytes_read, 0);
    EXPECT_GT(search.bytes(), 0);
    EXPECT_EQ(search.file_bytes(), static_cast<std::int64_t>(std::filesystem::file_size(path_)));
    EXPECT_THROW((void)search.active(std::numeric_limits<double>::quiet_NaN(), none), isoatlas::Error);
    EXPECT_THROW(BrickSearch("/missing.atlas"), isoatlas::Error);
}

}  // namespace
}  // namespace oracle
