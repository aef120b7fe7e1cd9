// The interval tree in a file finds the active cells, reads few blocks, and refuses what is damaged.
#include "isoatlas/disk_search.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "isoatlas/phantom.h"
#include "oracle/mesh_checks.h"
#include "oracle/stores.h"

namespace oracle {
namespace {

using isoatlas::CellId;
using isoatlas::CellSearchCost;
using isoatlas::IntervalTreeFile;
using isoatlas::SearchMethod;

std::vector<CellId> sorted(std::vector<CellId> cells) {
    std::sort(cells.begin(), cells.end());
    return cells;
}

std::vector<CellId> expected(const isoatlas::Volume& volume, double tau) {
    CellSearchCost cost;
    return isoatlas::make_cell_search(SearchMethod::brute_force, volume)->active(tau, cost);
}

class DiskSearch : public Stores {
protected:
    std::vector<CellId> found(double tau) {
        CellSearchCost cost;
        return sorted(IntervalTreeFile(path_).active(tau, cost));
    }
};

RC_GTEST_FIXTURE_PROP(DiskSearch, FindsTheActiveCells, ()) {
    const Grid grid = *arbitrary_grid(9, 700);
    const isoatlas::Volume volume = to_volume(grid, arbitrary_type(grid));
    isoatlas::write_interval_tree(path_, volume, {.block_bytes = *rc::gen::element<std::int64_t>(512, 1024, 4096)});
    for (const double tau : interesting_values(elements_of(grid, isoatlas::Interpolant::faces)))
        RC_ASSERT(found(tau) == expected(volume, tau));
}

TEST_F(DiskSearch, ReadsFewBlocks) {
    const isoatlas::Volume volume = isoatlas::make_phantom("random-field", {.size = 40});
    isoatlas::write_interval_tree(path_, volume, {.block_bytes = 1024});
    IntervalTreeFile file(path_);
    const std::int64_t in_block = 1016 / 12, nodes = file.levels();
    EXPECT_GT(file.cells(), 50000);
    for (const double tau : {-2.0, -1.0, 0.0, 1.0, 2.0}) {
        CellSearchCost cost;
        EXPECT_EQ(sorted(file.active(tau, cost)), expected(volume, tau));
        EXPECT_LE(cost.nodes, nodes);
        // The active cells, and in each node two lists that end inside a block and the multi lists of each first slab.
        EXPECT_LE(cost.blocks, cost.active / in_block + nodes * (3 + 2 * file.slabs() * file.slabs()));
    }
}

TEST_F(DiskSearch, RefusesDamage) {
    const isoatlas::Volume volume = isoatlas::make_phantom("noise", {.size = 12});
    isoatlas::write_interval_tree(path_, volume, {.block_bytes = 512});
    std::ifstream in(path_, std::ios::binary);
    const std::string good((std::istreambuf_iterator<char>(in)), {});
    const auto refuses = [&](const std::string& bytes) {
        std::ofstream(path_, std::ios::binary | std::ios::trunc) << bytes;
        for (const double tau : {0.25, 0.5, 0.75}) {
            try {
                if (found(tau) != expected(volume, tau)) return false;
            } catch (const isoatlas::Error& error) {
                if (error.kind() != isoatlas::ErrorKind::input) return false;
            }
        }
        return true;
    };
    for (const std::size_t size : {std::size_t{0}, std::size_t{31}, std::size_t{511}, std::size_t{512}, good.size() - 1, good.size() - 512})
        EXPECT_TRUE(refuses(good.substr(0, size))) << size;
    EXPECT_TRUE(refuses(good + "x"));
    for (std::size_t at = 0; at < good.size(); at += 97) {
        std::string bad = good;
        bad[at] = static_cast<char>(bad[at] ^ 0x10);
        EXPECT_TRUE(refuses(bad)) << at;
    }
    EXPECT_TRUE(refuses(good));
    EXPECT_THROW(isoatlas::write_interval_tree(path_, volume, {.block_bytes = 1000}), isoatlas::Error);
}

}  // namespace
}  // namespace oracle
