// The search table against the files themselves, written out as the dissertation says, and against what a store really reads.
#include "isoatlas/search_table.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <filesystem>
#include <set>

#include "isoatlas/atlas.h"
#include "isoatlas/build.h"
#include "isoatlas/phantom.h"
#include "oracle/compare.h"
#include "oracle/mesh_checks.h"
#include "oracle/volumes.h"
#include "oracle/zone_points.h"

namespace oracle {
namespace {

using isoatlas::Analysis;
using isoatlas::SearchCost;
using isoatlas::SearchTable;
using isoatlas::Volume;

double lowest(const Grid& grid, const std::vector<Index>& cell) {
    double low = kInfinity;
    for (const Index v : cell) low = std::min(low, grid.value[v]);
    return low;
}

double highest(const Grid& grid, const std::vector<Index>& cell) {
    double high = -kInfinity;
    for (const Index v : cell) high = std::max(high, grid.value[v]);
    return high;
}

struct File {
    double tau_low, tau_high;
    std::set<Index> points;
    std::vector<double> cells;  ///< their highest samples, descending
};

File file_of(const Grid& grid, const Analysis& analysis, isoatlas::EventId event) {
    const isoatlas::Event e = analysis.event(event);
    File file{e.zone.tau_low, e.zone.tau_high, zone_points(grid, analysis, event), {}};
    for (const auto& cell : cells_of(grid)) {
        if (std::ranges::any_of(cell, [&](Index v) { return file.points.contains(v); })) file.cells.push_back(highest(grid, cell));
    }
    std::ranges::sort(file.cells, std::greater<>());
    return file;
}

SearchCost cost_of(const Grid& grid, const std::vector<File>& files, double tau) {
    SearchCost cost{tau, 0, 0, 0, 0, 0};
    for (const auto& cell : cells_of(grid)) cost.active += lowest(grid, cell) < tau && tau <= highest(grid, cell);
    for (const File& file : files) {
        if (!(file.tau_low < tau && tau <= file.tau_high)) continue;
        cost.zones_loaded += static_cast<Index>(file.cells.size());
        for (const double high : file.cells) {
            ++cost.zones_visited;
            if (high < tau) break;
        }
    }
    return cost;
}

void search_tables_are_those_of_the_written_files() {
    const Grid grid = *arbitrary_grid();
    const Volume volume = to_volume(grid, arbitrary_type(grid));
    const Analysis analysis = isoatlas::analyse(volume, {.interpolant = *arbitrary_interpolant()});
    std::vector<File> files;
    double points = 0;
    std::set<double> values{*std::ranges::min_element(grid.value)};
    for (const isoatlas::EventId e : isoatlas::ids<isoatlas::EventId>(analysis.event_count())) {
        files.push_back(file_of(grid, analysis, e));
        points += static_cast<double>(files.back().points.size());
        values.insert(analysis.event(e).value);
    }
    const std::vector<SearchCost> costs = isoatlas::search_costs(volume, analysis, arbitrary_context());
    RC_ASSERT(costs.size() + 1 == values.size());
    auto value = values.begin();
    for (const SearchCost& cost : costs) {
        RC_ASSERT(*value < cost.tau);
        RC_ASSERT(cost.tau <= *++value);
        const SearchCost expected = cost_of(grid, files, cost.tau);
        RC_ASSERT(cost.active == expected.active);
        RC_ASSERT(cost.zones_loaded == expected.zones_loaded);
        RC_ASSERT(cost.zones_visited == expected.zones_visited);
        RC_ASSERT(cost.active <= cost.zones_visited);
        RC_ASSERT(cost.active <= cost.bricks_loaded);
    }
    const SearchTable table = isoatlas::search_table(volume, analysis, arbitrary_context());
    RC_ASSERT(table.cells == static_cast<Index>(cells_of(grid).size()));
    RC_ASSERT(table.zones == static_cast<Index>(files.size()));
    RC_ASSERT(std::abs(table.zone_points.average - points / static_cast<double>(files.size())) < 1e-9);
}

TEST(SearchTables, CountTheBricksThatAStoreReads) {
    const std::string path =
        (std::filesystem::temp_directory_path() / ("isoatlas_table_" + std::to_string(::getpid()) + ".atlas")).string();
    for (const char* name : {"random-field", "gyroid"}) {
        const Volume volume = isoatlas::make_phantom(name, {.size = 68});
        const std::vector<SearchCost> costs = isoatlas::search_costs(volume, isoatlas::analyse(volume));
        ASSERT_GT(costs.size(), 10U);
        isoatlas::build_atlas(path, volume);
        for (std::size_t i = 0; i < costs.size(); i += 1 + costs.size() / 50) {
            const isoatlas::Atlas atlas(path);
            (void)atlas.extract(costs[i].tau);
            EXPECT_EQ(atlas.reads().bricks, costs[i].bricks_read) << name << " at " << costs[i].tau;
        }
    }
    std::filesystem::remove(path);
}

RC_GTEST_PROP(SearchTables, AreThoseOfTheWrittenFiles, ()) { search_tables_are_those_of_the_written_files(); }

}  // namespace
}  // namespace oracle
