// Zone files give the active cells and the surface of every isovalue, read what the tables count, and refuse what is damaged.
#include "isoatlas/zone_files.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <set>
#include <string>

#include "base/memory_limit.h"
#include "faults/memory_files.h"
#include "isoatlas/phantom.h"
#include "oracle/mesh_checks.h"
#include "oracle/stores.h"
#include "oracle/write_file.h"
#include "oracle/zone_points.h"

namespace oracle {
namespace {

using isoatlas::Analysis;
using isoatlas::Boundary;
using isoatlas::CellId;
using isoatlas::CellSearchCost;
using isoatlas::ExtractOptions;
using isoatlas::Volume;
using isoatlas::ZoneFileReads;
using isoatlas::ZoneFileRow;
using isoatlas::ZoneFileSearch;
using isoatlas::ZoneLayout;

std::vector<CellId> active_by_brute_force(const Volume& volume, double tau) {
    CellSearchCost cost;
    return isoatlas::make_cell_search(isoatlas::SearchMethod::brute_force, volume)->active(tau, cost);
}

ExtractOptions plain(isoatlas::Interpolant interpolant, Boundary boundary) {
    ExtractOptions options{.interpolant = interpolant};
    options.surface.boundary = boundary;
    options.surface.normals = options.surface.ids = false;
    return options;
}

class ZoneFileBytes : public Stores {
protected:
    /// Written by so many threads, within a budget (0: none).
    [[nodiscard]] std::string bytes_of(const Volume& volume, const Analysis& analysis, ZoneLayout layout, int threads,
                                       std::int64_t budget) {
        std::optional<isoatlas::MemoryLimit> limit;
        if (budget > 0) limit.emplace(budget, testing::TempDir());
        isoatlas::write_zone_files(path_, volume, analysis, {.layout = layout}, {.threads = threads});
        std::ifstream in(path_, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
};

/// Files in memory.
class ZoneFiles : public testing::Test {
protected:
    isoatlas::test::MemoryFiles disk_;
    isoatlas::ReplacedFileSystem files_{disk_};
    std::string path_ = "zones";

    /// Of an arbitrary small volume, in a file of any kind.
    struct Filed {
        Grid grid;
        Volume volume;
        Analysis analysis;
        isoatlas::ZoneFileOptions options;
    };
    Filed arbitrary_file(Index longest = 7, Index most = 100) {
        Grid grid = *arbitrary_grid(longest, most);
        Volume volume = to_volume(grid, arbitrary_type(grid));
        volume.info.geometry = arbitrary_geometry(grid);
        Analysis analysis = isoatlas::analyse(volume, {.interpolant = *arbitrary_interpolant()});
        const isoatlas::ZoneFileOptions options{.block_bytes = *rc::gen::element<std::int64_t>(512, 1024, 65536),
                                                .layout = *rc::gen::element(ZoneLayout::by_zone, ZoneLayout::by_path)};
        isoatlas::write_zone_files(path_, volume, analysis, options);
        return {std::move(grid), std::move(volume), std::move(analysis), options};
    }
};

RC_GTEST_FIXTURE_PROP(ZoneFiles, GiveTheActiveCells, ()) {
    const Filed filed = arbitrary_file(9, 400);
    ZoneFileSearch file(path_);
    for (const double tau : interesting_values(elements_of(filed.grid, isoatlas::Interpolant::faces))) {
        CellSearchCost cost;
        RC_ASSERT(file.active(tau, cost) == active_by_brute_force(filed.volume, tau));
        const ZoneFileReads& reads = file.reads();
        RC_ASSERT(cost.active <= reads.entries_active);
        RC_ASSERT(reads.entries_active <= reads.cells_visited);
        RC_ASSERT(reads.cells_visited <= reads.cells_loaded);
        RC_ASSERT(cost.bytes_read == cost.blocks * filed.options.block_bytes);
    }
}

RC_GTEST_FIXTURE_PROP(ZoneFiles, GiveTheSurfaceWithoutTheVolume, ()) {
    const Filed filed = arbitrary_file();
    ZoneFileSearch file(path_);
    for (const double tau : interesting_values(elements_of(filed.grid, isoatlas::Interpolant::trilinear))) {
        for (const isoatlas::Interpolant interpolant : {isoatlas::Interpolant::faces, isoatlas::Interpolant::trilinear}) {
            for (const Boundary boundary : {Boundary::open, Boundary::closed}) {
                CellSearchCost cost;
                if (boundary == Boundary::closed && cells_of(filed.grid).empty()) {
                    RC_ASSERT_THROWS_AS((void)file.extract(tau, plain(interpolant, boundary), cost), isoatlas::Error);
                    continue;
                }
                const isoatlas::Surface found = file.extract(tau, plain(interpolant, boundary), cost);
                RC_ASSERT(same(found, isoatlas::extract(filed.volume, tau, plain(interpolant, boundary))));
            }
        }
    }
}

/// At most 4 lists of a cell begin at a sample above its neighbours in the cell, and a way to the root changes the path at most
/// log2(events) times.
RC_GTEST_FIXTURE_PROP(ZoneFiles, AreLinearByPath, ()) {
    const Grid grid = *arbitrary_grid(9, 400);
    const Volume volume = to_volume(grid, arbitrary_type(grid));
    const Analysis analysis = isoatlas::analyse(volume);
    isoatlas::write_zone_files(path_, volume, analysis);
    const ZoneFileSearch file(path_);
    const Index cells = std::ssize(cells_of(grid));
    RC_ASSERT(file.entries() <= 4 * cells * std::bit_width(static_cast<std::uint64_t>(file.events())));
    RC_ASSERT(file.entries() == isoatlas::count_zone_file_entries(volume, analysis, ZoneLayout::by_path));
    RC_ASSERT(file.zones() <= file.events());
    RC_ASSERT(file.components() <= file.zones());
}

RC_GTEST_FIXTURE_PROP(ZoneFiles, ReadWhatTheTableCounts, ()) {
    const Filed filed = arbitrary_file();
    ZoneFileSearch file(path_);
    const std::vector<isoatlas::SearchCost> costs = isoatlas::search_costs(filed.volume, filed.analysis);
    const std::vector<ZoneFileRow> rows = isoatlas::zone_file_table(file, filed.volume, filed.analysis, 1000);
    RC_ASSERT(rows.size() == costs.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const ZoneFileRow& row = rows[i];
        RC_ASSERT(row.counted.tau == costs[i].tau);
        RC_ASSERT(row.counted.bricks_loaded == costs[i].bricks_loaded);
        RC_ASSERT(row.cost.active == costs[i].active);
        RC_ASSERT(row.counted.active == costs[i].active);
        if (filed.options.layout == ZoneLayout::by_path) {
            RC_ASSERT(row.counted.zones_loaded == 0);
            continue;
        }
        RC_ASSERT(row.counted.zones_loaded == costs[i].zones_loaded);
        RC_ASSERT(row.reads.cells_filed == row.counted.zones_loaded);
        if (filed.options.block_bytes < 65536) continue;  // lists alone
        RC_ASSERT(row.reads.cells_visited <= row.counted.zones_visited + row.reads.components);
        RC_ASSERT(row.reads.cells_loaded <= row.counted.zones_loaded);
    }
}

/// The active zone that a sample belongs to at tau.
isoatlas::EventId object_of(const Analysis& analysis, Index voxel, double tau) {
    isoatlas::EventId e = analysis.zone(isoatlas::VoxelId(voxel));
    while (analysis.event(e).zone.tau_low >= tau) e = analysis.event(e).parent;
    return e;
}

/// By path, an entry is active for each object that crosses a cell: those of its High corners. Ends of zones are exact in double samples.
RC_GTEST_FIXTURE_PROP(ZoneFiles, HaveACellOnceForEachObject, ()) {
    const Grid grid = *arbitrary_grid();
    const Volume volume = to_volume(grid, isoatlas::ValueType::f64);
    const Analysis analysis = isoatlas::analyse(volume, {.interpolant = *arbitrary_interpolant()});
    isoatlas::write_zone_files(path_, volume, analysis, {.block_bytes = 512});
    ZoneFileSearch file(path_);
    for (const double tau : interesting_values(elements_of(grid, isoatlas::Interpolant::trilinear))) {
        Index pairs = 0;
        for (const auto& cell : cells_of(grid)) {
            std::set<isoatlas::EventId> objects;
            for (const Index v : cell) {
                if (grid.value[v] >= tau) objects.insert(object_of(analysis, v, tau));
            }
            if (std::ranges::any_of(cell, [&](Index v) { return grid.value[v] < tau; })) pairs += std::ssize(objects);
        }
        CellSearchCost cost;
        (void)file.active(tau, cost);
        RC_ASSERT(file.reads().entries_active == pairs);
    }
}

RC_GTEST_FIXTURE_PROP(ZoneFiles, HaveTheComponentsOfEachZone, ()) {
    const Grid grid = *arbitrary_grid();
    const Volume volume = to_volume(grid, arbitrary_type(grid));
    const Analysis analysis = isoatlas::analyse(volume, {.interpolant = *arbitrary_interpolant()});
    isoatlas::write_zone_files(path_, volume, analysis, {.block_bytes = 512, .layout = ZoneLayout::by_zone});
    Index components = 0, filed = 0;
    for (const isoatlas::EventId e : isoatlas::ids<isoatlas::EventId>(analysis.event_count())) {
        const std::set<Index> points = zone_points(grid, analysis, e);
        std::vector<std::set<Index>> parts;  // of points that cells join
        for (const auto& cell : cells_of(grid)) {
            std::set<Index> own;
            for (const Index v : cell) {
                if (points.contains(v)) own.insert(v);
            }
            if (own.empty()) continue;
            ++filed;
            std::vector<std::set<Index>> others;
            for (auto& part : parts) {
                if (std::ranges::any_of(part, [&](Index v) { return own.contains(v); }))
                    own.insert(part.begin(), part.end());
                else
                    others.push_back(part);
            }
            others.push_back(own);
            parts = std::move(others);
        }
        components += std::ssize(parts);
    }
    const ZoneFileSearch file(path_);
    RC_ASSERT(file.components() == components);
    RC_ASSERT(file.zones() == analysis.event_count());
    RC_ASSERT(isoatlas::count_zone_file_entries(volume, analysis, ZoneLayout::by_zone) == filed);
}

TEST_F(ZoneFiles, HaveACellBetweenTwoObjectsTwice) {
    const Volume volume = isoatlas::make_volume<float>({3, {2, 2, 2}}, std::vector<float>{9, 0, 0, 0, 0, 0, 0, 7});
    const Analysis analysis = isoatlas::analyse(volume, {.interpolant = isoatlas::Interpolant::faces});
    isoatlas::write_zone_files(path_, volume, analysis);
    ZoneFileSearch file(path_);
    EXPECT_EQ(file.entries(), 2);
    for (const auto& [tau, entries] : {std::pair{8.0, 1}, std::pair{5.0, 2}}) {
        CellSearchCost cost;
        EXPECT_EQ(file.active(tau, cost), std::vector{CellId(0)}) << tau;
        EXPECT_EQ(file.reads().entries_active, entries) << tau;
        EXPECT_EQ(cost.blocks, 1) << tau;
    }
}

TEST_F(ZoneFiles, OfOneHillAreOneTree) {
    std::vector<float> samples;
    for (int v = 0; v < 12 * 12 * 12; ++v) {
        const int x = v % 12 - 5, y = v / 12 % 12 - 6, z = v / 144 - 5;
        samples.push_back(static_cast<float>(-(x * x + y * y + z * z)));
    }
    const Volume volume = isoatlas::make_volume<float>({3, {12, 12, 12}}, samples);
    isoatlas::write_zone_files(path_, volume, isoatlas::analyse(volume), {.block_bytes = 512});
    ZoneFileSearch file(path_);
    EXPECT_EQ(file.events(), 1);
    EXPECT_EQ(file.components(), 1);
    EXPECT_EQ(file.entries(), 11 * 11 * 11);
    CellSearchCost cost;
    EXPECT_EQ(file.active(-30.5, cost), active_by_brute_force(volume, -30.5));
    EXPECT_GT(cost.nodes, 1);
    EXPECT_LT(cost.blocks, 2 * file.entries() / (504 / 44));
    EXPECT_LT(cost.bytes_read, file.file_bytes() / 2);
}

TEST_F(ZoneFiles, RefuseWhatIsTooLargeOrWrong) {
    const Volume volume = isoatlas::make_phantom("noise", {.size = 8});
    const Analysis analysis = isoatlas::analyse(volume);
    const std::int64_t entries = isoatlas::count_zone_file_entries(volume, analysis, ZoneLayout::by_zone);
    EXPECT_GT(entries, isoatlas::count_zone_file_entries(volume, analysis, ZoneLayout::by_path));
    for (const ZoneLayout layout : {ZoneLayout::by_zone, ZoneLayout::by_path}) {
        const std::int64_t all = isoatlas::count_zone_file_entries(volume, analysis, layout);
        EXPECT_NO_THROW(isoatlas::write_zone_files(path_, volume, analysis, {.layout = layout, .max_entries = all}));
        EXPECT_THROW(isoatlas::write_zone_files(path_, volume, analysis, {.layout = layout, .max_entries = all - 1}), isoatlas::Error);
    }
    const Volume other = isoatlas::make_phantom("noise", {.size = 9});
    EXPECT_THROW(isoatlas::write_zone_files(path_, other, analysis), isoatlas::Error);
    EXPECT_THROW(isoatlas::write_zone_files(path_, volume, isoatlas::analyse(volume, {.zones = false})), isoatlas::Error);
    EXPECT_THROW(isoatlas::write_zone_files(path_, volume, analysis, {.block_bytes = 1000}), isoatlas::Error);
    ZoneFileSearch file(path_);
    CellSearchCost cost;
    EXPECT_THROW((void)file.active(std::nan(""), cost), isoatlas::Error);
    EXPECT_THROW((void)file.extract(0.5, {}, cost), isoatlas::Error);
}

TEST_F(ZoneFileBytes, AreRefusedWhenDamaged) {
    const Volume volume = isoatlas::make_phantom("noise", {.size = 10});
    isoatlas::write_zone_files(path_, volume, isoatlas::analyse(volume), {.block_bytes = 512});
    std::ifstream in(path_, std::ios::binary);
    const std::string good((std::istreambuf_iterator<char>(in)), {});
    // Either refused, or the damaged block was not read.
    const auto refuses = [&](const std::string& bytes) {
        write_file(path_, bytes);
        for (const double tau : {0.25, 0.5, 0.75}) {
            try {
                CellSearchCost cost;
                if (ZoneFileSearch(path_).active(tau, cost) != active_by_brute_force(volume, tau)) return false;
            } catch (const isoatlas::Error& error) {
                if (error.kind() != isoatlas::ErrorKind::input) return false;
            }
        }
        return true;
    };
    const auto opens = [&](const std::string& bytes) {
        write_file(path_, bytes);
        try {
            (void)ZoneFileSearch(path_);
            return true;
        } catch (const isoatlas::Error&) {
            return false;
        }
    };
    for (const std::size_t size : {std::size_t{0}, std::size_t{31}, std::size_t{511}, std::size_t{512}, good.size() - 1, good.size() - 512})
        EXPECT_FALSE(opens(good.substr(0, size))) << size;
    EXPECT_FALSE(opens(good + "x"));
    for (std::size_t at = 0; at < good.size(); at += 1 + good.size() / 300) {
        std::string bad = good;
        bad[at] = static_cast<char>(bad[at] ^ 0x10);
        EXPECT_TRUE(refuses(bad)) << at;
    }
    std::string bad = good;
    bad[bad.size() - 20] = static_cast<char>(bad[bad.size() - 20] ^ 1);  // of the directory
    EXPECT_FALSE(opens(bad));
    EXPECT_TRUE(opens(good));
    EXPECT_TRUE(refuses(good));
}

TEST_F(ZoneFileBytes, AreTheSameForAnyThreadsAndMemory) {
    const auto is_the_same = [this](const Volume& volume, ZoneLayout layout) {
        const Analysis analysis = isoatlas::analyse(volume);
        const std::string bytes = bytes_of(volume, analysis, layout, 1, 0);
        EXPECT_GT(bytes.size(), std::size_t{1} << 23);
        EXPECT_TRUE(bytes == bytes_of(volume, analysis, layout, 3, 0));
        EXPECT_TRUE(bytes == bytes_of(volume, analysis, layout, 3, isoatlas::kMinMemory));
    };
    is_the_same(isoatlas::make_phantom("random-field", {.size = 64, .quantise = 20}), ZoneLayout::by_path);
    is_the_same(isoatlas::make_phantom("noise", {.size = 48}), ZoneLayout::by_path);
    std::vector<float> samples;  // two ridges; what is lower than the pass lies on both sides, and in the valley
    for (int v = 0; v < 64 * 64 * 64; ++v) {
        const int x = v % 64, y = v / 64 % 64, z = v / 4096;
        samples.push_back(static_cast<float>(-std::min((x - 24) * (x - 24), (x - 40) * (x - 40))) - 0.001F * static_cast<float>(y + z));
    }
    is_the_same(isoatlas::make_volume<float>({3, {64, 64, 64}}, samples), ZoneLayout::by_zone);
    const ZoneFileSearch file(path_);
    EXPECT_EQ(file.zones(), 3);
    EXPECT_EQ(file.components(), 5);
}

TEST_F(ZoneFileBytes, AreComparedWithBricks) {
    const Volume volume = isoatlas::make_phantom("random-field", {.size = 20});
    const Analysis analysis = isoatlas::analyse(volume);
    const std::string path = path_ + ".zones";
    isoatlas::build_atlas(path_, volume);
    isoatlas::write_zone_files(path, volume, analysis);
    ZoneFileSearch file(path);
    const std::vector<isoatlas::SearchCost> all = isoatlas::search_costs(volume, analysis);
    const std::vector<ZoneFileRow> rows = isoatlas::zone_file_table(file, volume, analysis, 5, path_);
    ASSERT_EQ(rows.size(), 5U);
    EXPECT_EQ(rows.front().counted.tau, all.front().tau);
    EXPECT_EQ(rows.back().counted.tau, all.back().tau);
    for (const ZoneFileRow& row : rows) {
        EXPECT_GT(row.cost.active, 0);
        EXPECT_GT(row.brick_bytes, 0);
        EXPECT_EQ(row.load_utility(), 100 * static_cast<double>(row.cost.active) / static_cast<double>(row.reads.cells_loaded));
        EXPECT_GE(row.travel_utility(), row.load_utility());
        EXPECT_LE(row.travel_utility(), 100);
    }
    EXPECT_THROW((void)isoatlas::zone_file_table(file, volume, analysis, 0), isoatlas::Error);
    std::filesystem::remove(path);
}

}  // namespace
}  // namespace oracle
