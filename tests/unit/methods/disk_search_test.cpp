// The interval tree in a file reads few blocks, has the same bytes in any memory, and refuses what is damaged. That it finds the active
// cells: cell_search_test.cpp.
#include "isoatlas/disk_search.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <numeric>
#include <optional>
#include <span>

#include "base/memory_limit.h"
#include "isoatlas/output.h"
#include "isoatlas/phantom.h"
#include "methods/disk/interval_tree_query.h"
#include "methods/disk/interval_tree_writer.h"
#include "oracle/mesh_checks.h"
#include "oracle/stores.h"
#include "oracle/write_file.h"
#include "unit/methods/searches.h"

namespace oracle {
namespace {

using isoatlas::CellId;
using isoatlas::CellSearchCost;
using isoatlas::IntervalTreeFile;
using isoatlas::SearchMethod;

std::vector<CellId> expected(const isoatlas::Volume& volume, double tau) {
    CellSearchCost cost;
    return isoatlas::make_cell_search(SearchMethod::brute_force, volume)->active(tau, cost);
}

/// Does a file of B entries a block keep what disk_search.h promises?
void expect_few(IntervalTreeFile& file, const isoatlas::Volume& volume, std::span<const double> taus) {
    const auto entry = static_cast<std::int64_t>(2 * isoatlas::size_of(volume.info.type) + 4);
    const std::int64_t in_block = (file.block_bytes() - 8) / entry;
    std::int64_t levels = 0;
    for (auto cells = static_cast<double>(file.cells()); cells > static_cast<double>(in_block); cells /= file.slabs()) ++levels;
    EXPECT_LE(file.levels(), levels);
    for (const double tau : taus) {
        CellSearchCost cost;
        EXPECT_EQ(found(file, tau, cost), expected(volume, tau));
        EXPECT_LE(cost.nodes, file.levels());
        EXPECT_LE(cost.blocks, 5 * cost.active / in_block + 8 * cost.nodes + 2) << tau;
        EXPECT_EQ(cost.bytes_read, cost.blocks * file.block_bytes());
    }
}

class DiskSearch : public Stores {
protected:
    std::vector<CellId> found(double tau) {
        CellSearchCost cost;
        return oracle::found(*std::make_unique<IntervalTreeFile>(path_), tau, cost);
    }
    /// Written within a budget, or in memory.
    [[nodiscard]] std::string bytes_of(const isoatlas::Volume& volume, std::int64_t budget) {
        std::optional<isoatlas::MemoryLimit> limit;
        if (budget > 0) limit.emplace(budget, testing::TempDir());
        isoatlas::write_interval_tree(path_, volume);
        std::ifstream in(path_, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
};

TEST_F(DiskSearch, ReadsFewBlocks) {
    for (const char* phantom : {"random-field", "noise"}) {
        for (const std::int64_t grey_levels : {0, 20, 256}) {
            const isoatlas::Volume volume = isoatlas::make_phantom(phantom, {.size = 32, .quantise = grey_levels});
            const auto value = [&](int i) { return volume.value(i * volume.info.extent.voxels() / 9); };
            const std::vector<double> taus{value(0), value(1), value(2), value(3) + 1e-3, value(4), value(5), value(6), value(7), value(8)};
            for (const std::int64_t block_bytes : {512, 1024, 4096, 65536}) {
                isoatlas::write_interval_tree(path_, volume, {.block_bytes = block_bytes});
                IntervalTreeFile file(path_);
                EXPECT_GT(file.cells(), 9000);
                expect_few(file, volume, taus);
            }
        }
    }
}

TEST_F(DiskSearch, IsColdAfterItsPagesAreDropped) {
    const isoatlas::Volume volume = isoatlas::make_phantom("noise", {.size = 12});
    isoatlas::write_interval_tree(path_, volume);
    IntervalTreeFile file(path_);
    CellSearchCost warm, cold;
    EXPECT_EQ(oracle::found(file, 0.5, warm), expected(volume, 0.5));
    file.drop_pages();
    EXPECT_EQ(oracle::found(file, 0.5, cold), expected(volume, 0.5));
    EXPECT_EQ(warm.blocks, cold.blocks);  // of the structure; what comes from the disk is up to the system
}

TEST_F(DiskSearch, HasTheSameBytesWithLittleMemory) {
    for (const char* phantom : {"random-field", "noise"}) {
        for (const std::int64_t grey_levels : {0, 20}) {
            const isoatlas::Volume volume = isoatlas::make_phantom(phantom, {.size = 64, .quantise = grey_levels});
            const std::string bytes = bytes_of(volume, 0);
            EXPECT_GT(bytes.size(), std::size_t{1} << 20);
            EXPECT_TRUE(bytes == bytes_of(volume, isoatlas::kMinMemory));
        }
    }
}

TEST_F(DiskSearch, ReadsItsVolumeSlabBySlab) {
    const isoatlas::Volume volume = isoatlas::make_phantom("noise", {.size = 12});
    const std::string whole = bytes_of(volume, 0), source = path_ + ".nrrd";
    isoatlas::write_volume(source, volume);
    isoatlas::write_interval_tree(path_, *isoatlas::open_volume(source));
    std::filesystem::remove(source);
    std::ifstream in(path_, std::ios::binary);
    EXPECT_TRUE(whole == std::string(std::istreambuf_iterator<char>(in), {}));
}

TEST_F(DiskSearch, IsNotThereWhenItWasCancelled) {
    const isoatlas::Volume volume = isoatlas::make_phantom("noise", {.size = 12});
    for (const int looks : {0, 1, 2}) {
        isoatlas::Context context;
        context.cancelled = [left = looks]() mutable { return left-- == 0; };
        EXPECT_THROW(isoatlas::write_interval_tree(path_, volume, {.block_bytes = 512}, context), isoatlas::Error);
        EXPECT_FALSE(std::filesystem::exists(path_));
    }
}

/// Entries of several trees in one file, some of them lists, some empty: each tree has its own.
RC_GTEST_FIXTURE_PROP(DiskSearch, KeepsSeveralTreesInAFile, ()) {
    using Cell = isoatlas::CellInterval<float>;
    isoatlas::test::MemoryFiles disk;
    const isoatlas::ReplacedFileSystem files(disk);
    std::vector<std::vector<Cell>> trees(*rc::gen::inRange<std::size_t>(1, 5));
    std::vector<isoatlas::IntervalTreePlace> places;
    isoatlas::BlockWriter writer("trees", "0123456789abcdef", 512);
    CellId next(0);
    const int values = *rc::gen::element(3, 20, 10000);
    for (std::vector<Cell>& tree : trees) {
        for (const int low : *rc::gen::container<std::vector<int>>(*rc::gen::element(0, 5, 41, 43, 500), rc::gen::inRange(0, values)))
            tree.push_back({static_cast<float>(low), static_cast<float>(low + 1 + (low * 37 + next.number()) % values), next}), ++next;
        places.push_back(isoatlas::IntervalTreeWriter<Cell>(writer).write({tree.begin(), tree.end()}, {}));
    }
    writer.commit({});
    const isoatlas::BlockReader reader("trees", "0123456789abcdef");
    for (std::size_t t = 0; t < trees.size(); ++t) {
        for (const double tau : {-1.0, 0.0, 0.5, 1.0, 2.0, values / 2.0, values + 0.0, 2.0 * values}) {
            std::vector<CellId> active, reported;
            for (const Cell& cell : trees[t]) {
                if (cell.low < tau && tau <= cell.high) active.push_back(cell.cell);
            }
            CellSearchCost cost;
            isoatlas::IntervalTreeQuery<Cell>(reader, tau, cost).run(places[t], [&](const Cell& cell) { reported.push_back(cell.cell); });
            std::sort(reported.begin(), reported.end());
            RC_ASSERT(reported == active);
        }
    }
}

/// Windows of a corner structure cover the slabs in order and have at most twice what is active in a slab and a block, all together less
/// than five times what there is; a slab reads what is active in it once, and what begins and ends in the window before it.
RC_GTEST_PROP(CornerStructure, IsShortAndReadsLittle, ()) {
    const int slabs = *rc::gen::inRange(2, 30);
    const auto in_block = *rc::gen::inRange<std::int64_t>(2, 200);
    std::vector<std::int64_t> count;
    for (int i = 0; i < slabs * slabs; ++i)
        count.push_back(*rc::gen::inRange(0, 3) == 0 ? *rc::gen::inRange<std::int64_t>(0, (in_block + 1) / 2) : 0);
    const auto count_of = [&](int p, int q) { return count[static_cast<std::size_t>(p * slabs + q)]; };
    const auto reaching = [&](int first, int last) {
        std::int64_t entries = 0;
        for (int p = 1; p <= last; ++p) {
            for (int q = std::max(p, first); q <= slabs - 2; ++q) entries += count_of(p, q);
        }
        return entries;
    };
    const isoatlas::CornerStructure corner(slabs, in_block, count_of);
    int next = 1;
    for (const isoatlas::CornerStructure::Window& window : corner.windows()) {
        RC_ASSERT(window.first == next && window.last >= window.first);
        RC_ASSERT(window.entries == reaching(window.first, window.last));
        for (int slab = window.first; slab <= window.last; ++slab) {
            RC_ASSERT(window.entries <= 2 * reaching(slab, slab) + in_block);
            std::int64_t read = 0, active = 0, begin_and_end_there = 0;
            for (std::size_t part = corner.first_part(slab); part <= corner.last_part(slab); ++part) read += corner.sizes()[part];
            for (int p = 1; p <= slabs - 2; ++p) {
                for (int q = p; q <= slabs - 2; ++q) {
                    corner.for_parts(p, q, [&](std::size_t part) {
                        if (part < corner.first_part(slab) || part > corner.last_part(slab)) return;
                        active += p <= slab && slab <= q ? count_of(p, q) : 0;
                        begin_and_end_there += p > window.first && q < slab ? count_of(p, q) : 0;
                    });
                }
            }
            RC_ASSERT(active == reaching(slab, slab));
            RC_ASSERT(read == active + begin_and_end_there);
        }
        next = window.last + 1;
    }
    RC_ASSERT(next == std::max(1, slabs - 1));
    const std::int64_t all = std::reduce(corner.sizes().begin(), corner.sizes().end());
    RC_ASSERT(all <= 5 * reaching(1, slabs - 2));
}

TEST_F(DiskSearch, RefusesDamage) {
    const isoatlas::Volume volume = isoatlas::make_phantom("noise", {.size = 12});
    isoatlas::write_interval_tree(path_, volume, {.block_bytes = 512});
    std::ifstream in(path_, std::ios::binary);
    const std::string good((std::istreambuf_iterator<char>(in)), {});
    const auto refuses = [&](const std::string& bytes) {
        write_file(path_, bytes);
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
