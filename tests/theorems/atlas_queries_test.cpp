// What a store tells beside surfaces: its objects, what a query will cost and has cost, how much memory it takes.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <atomic>
#include <set>
#include <sstream>
#include <thread>

#include "atlas/overview.h"
#include "atlas/tree_arrays.h"
#include "isoatlas/cavities.h"
#include "isoatlas/objects.h"
#include "isoatlas/octree_front.h"
#include "isoatlas/phantom.h"
#include "oracle/difference.h"
#include "oracle/stores.h"
#include "store/brick_writer.h"
#include "store/container.h"

namespace oracle {
namespace {

using isoatlas::Atlas;
using isoatlas::Surface;
using isoatlas::Volume;

/// Cells with a High corner of the object (its position in the cut) and a Low one, cells at the border included.
Index active_cells_of(const isoatlas::Cut& cut, const Volume& volume, int object) {
    const isoatlas::Extent& extent = volume.info.extent;
    const Index flat = extent.rank == 2 ? 1 : 0;
    Index count = 0;
    for (Index z = flat - 1; z < extent.size[2]; ++z) {
        for (Index y = -1; y < extent.size[1]; ++y) {
            for (Index x = -1; x < extent.size[0]; ++x) {
                bool own = false, low = false;
                for (Index c = 0; c < (flat != 0 ? 4 : 8); ++c) {
                    const Index i = x + c % 2, j = y + c / 2 % 2, k = z + c / 4;
                    const bool inside = i >= 0 && j >= 0 && k >= 0 && i < extent.size[0] && j < extent.size[1] && k < extent.size[2];
                    const int label = inside ? cut.label[static_cast<std::size_t>(extent.index(i, j, k))] : -1;
                    own = own || label == object;
                    low = low || label < 0;
                }
                count += own && low;
            }
        }
    }
    return count;
}

RC_GTEST_FIXTURE_PROP(Stores, CountWhatAQueryCosts, ()) {
    const Grid grid = arbitrary_volume();
    const Volume volume = to_volume(grid, arbitrary_type(grid));
    isoatlas::build_atlas(path_, volume);
    const Atlas atlas(path_);
    const double tau = grid.value[*rc::gen::inRange<std::size_t>(0, grid.value.size())];
    const isoatlas::Cut cut = isoatlas::cut(volume, tau, {.label = true});
    isoatlas::QueryCost all, again, one, from_cut;
    (void)atlas.extract(tau, {}, {}, &all);
    (void)atlas.extract(tau, {}, {}, &again);
    (void)atlas.cut(tau, {}, {}, &from_cut);
    RC_ASSERT(all.cells_active == cut.active_cells);
    RC_ASSERT(from_cut.cells_active == cut.active_cells);
    RC_ASSERT(all.bricks == atlas.reads().bricks);
    RC_ASSERT(all.cells_loaded <= volume.info.extent.voxels());
    RC_ASSERT(all.cells_loaded == all.cells_visited);
    RC_ASSERT(again.cells_loaded == 0);
    RC_ASSERT(again.cells_visited == all.cells_visited);
    const int object = *rc::gen::inRange<int>(0, static_cast<int>(cut.objects.size()));
    isoatlas::SurfaceOptions options;
    options.objects = {cut.objects[static_cast<std::size_t>(object)].id};
    (void)Atlas(path_).extract(tau, options, {}, &one);
    RC_ASSERT(one.cells_active == active_cells_of(cut, volume, object));
}

RC_GTEST_FIXTURE_PROP(Stores, HaveTheFrontsOfTheirVolume, ()) {
    Grid grid = *arbitrary_grid(9, 400);
    grid.rank = 3;
    const Volume volume = to_volume(grid, arbitrary_type(grid));
    isoatlas::build_atlas(path_, volume);
    const Atlas atlas(path_);
    const double tau = grid.value[*rc::gen::inRange<std::size_t>(0, grid.value.size())];
    isoatlas::SurfaceOptions options;
    const isoatlas::Cut cut = isoatlas::cut(volume, tau);
    if (*rc::gen::arbitrary<bool>()) options.objects = {cut.objects[*rc::gen::inRange<std::size_t>(0, cut.objects.size())].id};
    const isoatlas::FrontOptions blocks{.max_level = *rc::gen::inRange(0, 4), .triangles = *rc::gen::element(0, 100)};
    const isoatlas::FrontSurface stored = atlas.extract_front(tau, blocks, options);
    const isoatlas::FrontSurface whole = extract_front(volume, tau, blocks, {.surface = options});
    const auto chi = [](const Surface& surface) {
        std::vector<Index> numbers = inspect(surface.points, surface.triangles).component_chi;
        std::ranges::sort(numbers);
        return numbers;
    };
    RC_ASSERT(chi(stored.surface) == chi(whole.surface));
    const std::set<Index> contours(stored.surface.contour.begin(), stored.surface.contour.end());
    RC_ASSERT(contours == std::set<Index>(whole.surface.contour.begin(), whole.surface.contour.end()));
    if (options.objects.empty()) {
        RC_ASSERT(std::ranges::equal(stored.surface.points, whole.surface.points));
        RC_ASSERT(std::ranges::equal(stored.surface.triangles, whole.surface.triangles));
        RC_ASSERT(stored.leaves == whole.leaves);
    }
}

void check_bounds(const isoatlas::Bounds& bounds, Index number, bool exact) {
    RC_ASSERT(bounds.min <= number);
    RC_ASSERT(number <= bounds.max);
    RC_ASSERT(!exact || bounds.min == bounds.max);
}

/// Samples are counted between any edges.
void check_histogram(const Atlas& atlas, const Grid& grid) {
    auto edges = *rc::gen::container<std::vector<double>>(*rc::gen::inRange<std::size_t>(2, 6), rc::gen::elementOf(grid.value));
    std::ranges::sort(edges);
    if (*rc::gen::inRange(0, 2) == 0) edges.front() -= 0.5, edges.back() += 0.5;
    const std::vector<std::int64_t> counts = atlas.histogram(edges);
    RC_ASSERT(counts.size() + 1 == edges.size());
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const bool is_last = edges[i + 1] == edges.back() && i + 1 == counts.size();
        const auto expected = std::ranges::count_if(
            grid.value, [&](double value) { return value >= edges[i] && (value < edges[i + 1] || (is_last && value == edges[i + 1])); });
        RC_ASSERT(counts[i] == expected);
    }
    RC_ASSERT_THROWS_AS((void)atlas.histogram(std::vector<double>{2, 1}), isoatlas::Error);
}

RC_GTEST_FIXTURE_PROP(Stores, EstimateWhatAQueryFindsAndCosts, ()) {
    const Grid grid = arbitrary_volume();
    const Volume volume = to_volume(grid, arbitrary_type(grid));
    const isoatlas::AnalysisOptions options{.interpolant = *arbitrary_interpolant()};
    isoatlas::build_atlas(path_, volume, options);
    const Atlas atlas(path_);
    double tau = grid.value[*rc::gen::inRange<std::size_t>(0, grid.value.size())];
    if (*rc::gen::inRange(0, 3) == 0) tau += 0.3;
    const isoatlas::SurfacePreview preview = atlas.preview(tau);
    RC_ASSERT(atlas.reads().bricks == 0);
    const isoatlas::Cut cut = isoatlas::cut(volume, tau, {.interpolant = options.interpolant});
    isoatlas::QueryCost cost;
    const Surface surface = atlas.extract(tau, {}, {}, &cost);
    check_histogram(atlas, grid);
    RC_ASSERT(preview.objects == static_cast<Index>(cut.objects.size()));
    RC_ASSERT(preview.contours == static_cast<Index>(cut.contours.size()));
    Index voxels = 0, tunnels = 0, hits = 0;
    for (const auto& object : cut.objects) voxels += object.voxels, tunnels += object.b1;
    for (const auto& contour : cut.contours) hits += contour.hits;
    const bool few_values = isoatlas::size_of(volume.info.type) == 1;
    RC_ASSERT(preview.tunnels == tunnels);
    check_bounds(preview.voxels, voxels, few_values);
    check_bounds(preview.cells, cost.cells_active, few_values);
    check_bounds(preview.points, hits, few_values);
    check_bounds(preview.bricks, cost.bricks, false);
    check_bounds(preview.bytes, cost.bytes, false);
    check_bounds(preview.extents, cost.extents, false);
    const Index more = static_cast<Index>(surface.points.size()) - hits;  // articulation points
    RC_ASSERT(more >= 0);
    if (volume.info.extent.rank == 3) check_bounds(preview.triangles, static_cast<Index>(surface.triangles.size()) - 2 * more, few_values);
    if (volume.info.extent.rank == 2) check_bounds(preview.triangles, static_cast<Index>(surface.segments.size()), few_values);
}

std::string text(const isoatlas::ObjectTable& table) {
    std::ostringstream out;
    out.precision(17);
    out << table.branches << ' ' << table.noise << '\n';
    for (const auto& o : table.entries) {
        out << o.id << ' ' << o.event.number() << ' ' << o.appears << ' ' << o.merges << ' ' << o.best_tau << ' ' << o.voxels << ' '
            << o.measure << ' ' << o.tunnels << ' ' << o.cavities << ' ' << o.hypervolume << ' ' << join(o.position) << o.tau_low << ' '
            << o.tau_high << ' ' << o.inside << ' ' << o.branch_top.number() << ' ' << o.note << '\n';
        RC_ASSERT(isoatlas::isovalue_of(table, o).has_value());
    }
    for (const auto& i : table.isovalues)
        out << i.branch_top << ' ' << i.tau << ' ' << i.prominence << ' ' << name_of(i.reason) << ' ' << i.cavity << '\n';
    return out.str();
}

std::string text(const isoatlas::CavityTable& table) {
    std::ostringstream out;
    out.precision(17);
    out << table.branches << ' ' << table.noise << '\n';
    for (const auto& o : table.entries) {
        out << o.id << ' ' << o.appears << ' ' << o.merges << ' ' << o.best_tau << ' ' << o.voxels << ' ' << o.measure << ' '
            << o.hypervolume << ' ' << o.object << ' ' << o.tunnels << ' ' << o.islands << ' ' << join(o.position) << o.tau_low << ' '
            << o.tau_high << ' ' << o.inside << ' ' << name_of(o.reason) << ' ' << o.branch_minimum << ' ' << o.note << '\n';
    }
    for (const auto& i : table.isovalues)
        out << i.branch_top << ' ' << i.tau << ' ' << i.prominence << ' ' << name_of(i.reason) << ' ' << i.cavity << '\n';
    return out.str();
}

isoatlas::Selection arbitrary_selection(const isoatlas::BranchHierarchy& hierarchy) {
    const auto& some = hierarchy.branches()[*rc::gen::inRange<std::size_t>(0, hierarchy.branches().size())];
    isoatlas::Selection selection;
    switch (*rc::gen::inRange(0, 4)) {
        case 0: selection.keep = *rc::gen::inRange<std::int64_t>(1, 9); break;
        case 1: selection.min_persistence = some.persistence; break;
        case 2: selection.min_hypervolume = some.hypervolume; break;
        default: selection.min_measure = some.measure;
    }
    return selection;
}

std::string text(const isoatlas::BranchHierarchy& hierarchy, const isoatlas::Selection& selection) {
    std::ostringstream out;
    out.precision(17);
    for (const isoatlas::BranchInfo& b : hierarchy.branches())
        out << b.id << ' ' << b.top.number() << ' ' << b.parent.number() << ' ' << b.merges << ' ' << b.hypervolume << ' ' << b.voxels
            << ' ' << b.measure << '\n';
    out << join(numbers_of(hierarchy.significant())) << '\n' << join(hierarchy.simplify(selection).node_of_event);
    return out.str();
}

RC_GTEST_FIXTURE_PROP(Stores, SelectAsVolumesDo, ()) {
    const Grid grid = arbitrary_volume();
    Volume volume = to_volume(grid, arbitrary_type(grid));
    volume.info.geometry = arbitrary_geometry(grid);
    isoatlas::build_atlas(path_, volume);
    const isoatlas::Analysis analysis = isoatlas::analyse(volume);
    const isoatlas::BranchHierarchy hierarchy(volume, analysis);
    const isoatlas::Selection selection = arbitrary_selection(hierarchy);
    const Atlas atlas(path_);
    RC_ASSERT(text(atlas.hierarchy(), selection) == text(hierarchy, selection));
    for (const std::int64_t top : {0, 3}) {
        const isoatlas::RankOptions options{.top = top, .selection = selection};
        RC_ASSERT(text(atlas.objects(options)) == text(isoatlas::rank_objects(volume, analysis, options)));
    }
}

RC_GTEST_FIXTURE_PROP(Stores, HoldTheTableOfCavities, ()) {
    const Grid grid = arbitrary_volume();
    const Volume volume = to_volume(grid, arbitrary_type(grid));
    isoatlas::build_atlas(path_, volume);
    const Atlas atlas(path_);
    for (const std::int64_t top : {0, 2})
        RC_ASSERT(text(atlas.cavities({.top = top})) == text(rank_cavities(volume, isoatlas::analyse(volume), {.top = top})));
}

/// A store of the same volume without its tables, as one of noise with too many critical elements is.
void leave_tables_out(const std::string& from, const Volume& volume, const std::string& to) {
    const isoatlas::Container store(from);
    std::vector<isoatlas::PackedArray> arrays = isoatlas::brick_arrays(volume, {});
    for (isoatlas::PackedArray& array : isoatlas::copied_arrays(store)) {
        const auto lies_in = [&array](const char* folder) { return array.name.starts_with(folder); };
        if (std::ranges::any_of(std::array{"elements/", "census/"}, lies_in)) arrays.push_back(std::move(array));
    }
    isoatlas::pack_store(to, store.contents(), arrays);
}

RC_GTEST_FIXTURE_PROP(Stores, GiveTheSameTablesTogetherAsApart, ()) {
    const Grid grid = arbitrary_volume();
    Volume volume = to_volume(grid, arbitrary_type(grid));
    volume.info.geometry = arbitrary_geometry(grid);
    isoatlas::build_atlas(path_, volume);
    const std::string bare = path_ + ".bare";
    leave_tables_out(path_, volume, bare);
    const isoatlas::Analysis analysis = isoatlas::analyse(volume);
    const isoatlas::BranchHierarchy hierarchy(volume, analysis);
    for (const isoatlas::RankOptions& options : {isoatlas::RankOptions{.top = 3}, isoatlas::RankOptions{.top = 9, .gate = false}}) {
        const isoatlas::ObjectsAndCavities both = isoatlas::rank_both(volume, analysis, options);
        RC_ASSERT(text(both.objects) == text(isoatlas::rank_objects(volume, analysis, options)));
        RC_ASSERT(text(both.cavities) == text(rank_cavities(volume, analysis, options)));
    }
    for (const std::string& path : {path_, bare}) {
        const Atlas atlas(path);
        const isoatlas::Overview found = isoatlas::overview_of(atlas, {});
        RC_ASSERT(text(found.objects) == text(isoatlas::rank_objects(volume, analysis, {.top = 0})));
        RC_ASSERT(text(found.cavities) == text(rank_cavities(volume, analysis, {.top = 0})));
        RC_ASSERT(text(found.hierarchy, {}) == text(hierarchy, {}));
        RC_ASSERT(atlas.active(grid.value[0]).objects.size() == Atlas(path).active(grid.value[0]).objects.size());
    }
    std::filesystem::remove(bare);
}

RC_GTEST_FIXTURE_PROP(Stores, HoldTheTableOfObjects, ()) {
    const Grid grid = arbitrary_volume();
    Volume volume = to_volume(grid, arbitrary_type(grid));
    volume.info.geometry = arbitrary_geometry(grid);
    isoatlas::build_atlas(path_, volume);
    const isoatlas::Analysis analysis = isoatlas::analyse(volume);
    const Atlas atlas(path_);
    for (const std::int64_t top : {0, 1, 2, 5, 24}) {
        RC_ASSERT(text(atlas.objects({.top = top})) == text(isoatlas::rank_objects(volume, analysis, {.top = top})));
        RC_ASSERT(atlas.reads().bricks == 0);
    }
    const isoatlas::RankOptions all{.top = 30, .gate = false};
    RC_ASSERT(text(atlas.objects(all)) == text(isoatlas::rank_objects(volume, analysis, all)));
}

TEST_F(Stores, FindTheObjectsFromTheTreesAlone) {
    const Volume volume = isoatlas::make_phantom("random-field", {.size = 40, .noise = 0.1, .quantise = 64});
    isoatlas::build_atlas(path_, volume);
    const Atlas atlas(path_);
    for (double tau = -0.5; tau < 64; tau += 4.5) {
        const isoatlas::Cut cut = isoatlas::cut(volume, tau);
        const isoatlas::ActiveObjects active = atlas.active(tau);
        ASSERT_EQ(active.objects.size(), cut.objects.size());
        ASSERT_EQ(active.contours.size(), cut.contours.size());
        std::set<Index> ids, expected;
        for (const auto& object : active.objects) ids.insert(object.id);
        for (const auto& object : cut.objects) expected.insert(object.id);
        EXPECT_EQ(ids, expected);
    }
    EXPECT_EQ(atlas.reads().bricks, 0);
}

// With hardly any room bricks come and go all the time, also while others are being read.
TEST_F(Stores, KeepToTheirBudget) {
    const Volume volume = isoatlas::make_phantom("random-field", {.size = 48, .noise = 0.1, .quantise = 64});
    isoatlas::build_atlas(path_, volume);
    std::vector<Surface> expected;
    for (int i = 0; i < 6; ++i) expected.push_back(isoatlas::extract(volume, 10 * i + 3));
    for (const std::int64_t budget : {1, 40000, 100000000}) {
        const Atlas atlas(path_, {.cache_bytes = budget});
        EXPECT_EQ(atlas.present_bytes(), 0);
        std::atomic<int> wrong = 0;
        ask_at_once([&](int asker, const isoatlas::Context& context) {
            for (int i = 0; i < 6; ++i) {
                const int which = (i * 5 + asker) % 6;
                const auto& surface = expected[static_cast<std::size_t>(which)];
                wrong += same(atlas.extract(10 * which + 3, {}, context), surface) ? 0 : 1;
                isoatlas::SurfaceOptions one;
                one.objects = {surface.object.at(surface.object.size() / 2)};
                wrong += atlas.extract(10 * which + 3, one, context).points.empty() ? 1 : 0;
                if (i % 3 == 0) atlas.clear_cache();
            }
        });
        EXPECT_EQ(wrong, 0);
        EXPECT_LE(atlas.present_bytes(), budget);
    }
}

TEST_F(Stores, CountTheMemoryOfTheirBricks) {
    const Volume volume = isoatlas::make_phantom("nested-shells", {.size = 96});
    isoatlas::build_atlas(path_, volume);
    const Atlas atlas(path_);
    (void)atlas.extract(0.5);
    const std::int64_t all = atlas.present_bytes();
    EXPECT_GT(all, 0);
    EXPECT_LE(all, static_cast<std::int64_t>(volume.bytes.size()) + 8192);
    const isoatlas::AtlasReads before = atlas.reads();
    (void)atlas.extract(0.5);
    EXPECT_EQ(atlas.reads().bricks, before.bricks);
    atlas.clear_cache();
    EXPECT_EQ(atlas.present_bytes(), 0);
    (void)atlas.extract(0.5);
    EXPECT_EQ(atlas.reads().bricks, 2 * before.bricks);
    EXPECT_EQ(atlas.present_bytes(), all);
}

}  // namespace
}  // namespace oracle
