// Every search method, in memory and in a file, finds the active cells: those of a loop over cells and corners.
#include "isoatlas/cell_search.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "oracle/mesh_checks.h"
#include "unit/methods/searches.h"

namespace oracle {
namespace {

using isoatlas::CellId;
using isoatlas::CellSearchCost;
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

/// The name of a search that finds something else; empty: none does.
std::string wrong_search(const Grid& grid, const isoatlas::Volume& volume, const std::vector<double>& taus, std::int64_t block_bytes) {
    Searches searches(volume, block_bytes);
    for (const double tau : taus) {
        const std::vector<CellId> expected = active_cells(grid, tau);
        for (const auto& [name, search] : searches.all()) {
            CellSearchCost cost;
            if (found(*search, tau, cost) != expected || cost.active != std::ssize(expected) || cost.cells < cost.active)
                return name + " at " + std::to_string(tau);
        }
    }
    return {};
}

RC_GTEST_PROP(CellSearches, FindTheActiveCells, ()) {
    for (int volumes = 0; volumes < 5; ++volumes) {
        const Grid grid = *arbitrary_grid(9, volumes == 0 ? 300 : 60);  // a large one takes 25 times as long
        const isoatlas::Volume volume = to_volume(grid, arbitrary_type(grid));
        std::vector<double> taus = isovalues(grid);
        if (*rc::gen::arbitrary<bool>()) std::reverse(taus.begin(), taus.end());
        if (taus.size() > 3 && *rc::gen::arbitrary<bool>())
            std::rotate(taus.begin(), taus.begin() + 1, taus.begin() + *rc::gen::inRange(2, 4));
        RC_ASSERT(wrong_search(grid, volume, taus, *rc::gen::element<std::int64_t>(512, 512, 4096)) == "");
    }
}

TEST(CellSearches, HavePlateausAndVolumesOfOneCellOrNone) {
    std::vector<int> raw(4000);
    for (std::size_t i = 0; i < raw.size(); ++i) raw[i] = static_cast<int>(i * i * 7919 % 10000);
    const std::vector<std::array<Index, 3>> sizes{{1, 1, 1},  {40, 1, 1}, {1, 40, 1},  {1, 1, 40},  {2, 2, 2}, {2, 40, 1},
                                                  {40, 2, 2}, {2, 2, 40}, {1, 20, 20}, {20, 20, 1}, {9, 8, 7}};
    for (const std::array<Index, 3>& size : sizes) {
        for (const int rank : {2, 3}) {
            for (const Texture texture :
                 {Texture::constant, Texture::ties2, Texture::plateaus, Texture::checkerboard_ties, Texture::smooth}) {
                const Grid grid = make_grid(rank, {size[0], size[1], rank == 2 ? 1 : size[2]}, texture, raw);
                EXPECT_EQ(wrong_search(grid, to_volume(grid, isoatlas::ValueType::f64), isovalues(grid), 512), "")
                    << rank << "D " << size[0] << " " << size[1] << " " << size[2];
            }
        }
    }
}

TEST(CellSearches, HaveAllValues) {
    const double huge = std::numeric_limits<double>::max();
    for (const std::vector<double>& values :
         {std::vector<double>{-huge, 0, huge, 1, 0, 0, 0, huge}, {1, std::nextafter(1.0, 2.0), 1, 1, 1, 1, 1, 1}}) {
        const isoatlas::Volume volume = isoatlas::make_volume<double>({3, {2, 2, 2}}, values);
        const std::vector<double> taus{-huge, 0.0, 1.0, std::nextafter(1.0, 2.0), huge};
        EXPECT_EQ(wrong_search(Grid{3, {2, 2, 2}, values}, volume, taus, 512), "");
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
