// Every search method finds the active cells: those of a loop over cells and corners.
#include "isoatlas/cell_search.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "oracle/mesh_checks.h"

namespace oracle {
namespace {

using isoatlas::CellId;
using isoatlas::CellSearch;
using isoatlas::CellSearchCost;
using isoatlas::SearchMethod;
using isoatlas::SearchMethodInfo;

/// Ascending.
std::vector<CellId> active_cells(const Grid& grid, double tau) {
    std::vector<CellId> cells;
    std::int64_t number = 0;
    const Index depth = grid.rank == 2 ? 1 : grid.size[2] - 1;
    for (Index z = 0; z < depth; ++z) {
        for (Index y = 0; y + 1 < grid.size[1]; ++y) {
            for (Index x = 0; x + 1 < grid.size[0]; ++x, ++number) {
                int highs = 0, lows = 0;
                for (int corner = 0; corner < (grid.rank == 2 ? 4 : 8); ++corner) {
                    const Index v = x + (corner & 1) + grid.size[0] * (y + (corner >> 1 & 1) + grid.size[1] * (z + (corner >> 2)));
                    ++(grid.value[v] >= tau ? highs : lows);
                }
                if (highs > 0 && lows > 0) cells.emplace_back(number);
            }
        }
    }
    return cells;
}

std::vector<double> isovalues(const Grid& grid) {
    std::set<double> values(grid.value.begin(), grid.value.end());
    std::vector<double> all{*values.begin() - 1};
    for (const double value : values) {
        all.push_back(value);
        all.push_back(std::nextafter(value, std::numeric_limits<double>::infinity()));
    }
    return all;
}

std::vector<CellId> found(CellSearch& search, double tau, CellSearchCost& cost) {
    std::vector<CellId> cells = search.active(tau, cost);
    std::sort(cells.begin(), cells.end());
    return cells;
}

RC_GTEST_PROP(CellSearches, FindTheActiveCells, ()) {
    const Grid grid = *arbitrary_grid(9, 300);
    const isoatlas::Volume volume = to_volume(grid, arbitrary_type(grid));
    std::vector<double> taus = isovalues(grid);
    if (*rc::gen::arbitrary<bool>()) std::reverse(taus.begin(), taus.end());
    if (taus.size() > 3 && *rc::gen::arbitrary<bool>()) std::rotate(taus.begin(), taus.begin() + 1, taus.begin() + *rc::gen::inRange(2, 4));
    for (const SearchMethodInfo& info : isoatlas::search_methods()) {
        const std::unique_ptr<CellSearch> search = isoatlas::make_cell_search(info.method, volume);
        for (const double tau : taus) {
            CellSearchCost cost;
            const std::vector<CellId> expected = active_cells(grid, tau);
            if (found(*search, tau, cost) != expected) RC_FAIL(std::string(info.name) + " at " + std::to_string(tau));
            RC_ASSERT(cost.active == std::ssize(expected));
            RC_ASSERT(cost.cells >= cost.active);
        }
    }
}

TEST(CellSearches, HaveAllValues) {
    const double huge = std::numeric_limits<double>::max();
    for (const std::vector<double>& values :
         {std::vector<double>{-huge, 0, huge, 1, 0, 0, 0, huge}, {1, std::nextafter(1.0, 2.0), 1, 1, 1, 1, 1, 1}}) {
        const isoatlas::Volume volume = isoatlas::make_volume<double>({3, {2, 2, 2}}, values);
        for (const SearchMethodInfo& info : isoatlas::search_methods()) {
            const std::unique_ptr<CellSearch> search = isoatlas::make_cell_search(info.method, volume);
            for (const double tau : {-huge, 0.0, 1.0, std::nextafter(1.0, 2.0), huge}) {
                CellSearchCost cost;
                EXPECT_EQ(found(*search, tau, cost), active_cells(Grid{3, {2, 2, 2}, values}, tau)) << info.name << " at " << tau;
            }
        }
    }
}

TEST(CellSearches, HaveNamesAndRefuseWhatIsNoIsovalue) {
    std::set<std::string_view> names;
    const isoatlas::Volume volume = isoatlas::make_volume<double>({3, {2, 2, 2}}, std::vector<double>{0, 1, 0, 1, 0, 1, 0, 1});
    for (const SearchMethodInfo& info : isoatlas::search_methods()) {
        EXPECT_TRUE(names.insert(info.name).second);
        EXPECT_EQ(&isoatlas::info_of(info.method), &info);
        CellSearchCost cost;
        EXPECT_THROW((void)isoatlas::make_cell_search(info.method, volume)->active(std::nan(""), cost), isoatlas::Error) << info.name;
    }
}

}  // namespace
}  // namespace oracle
