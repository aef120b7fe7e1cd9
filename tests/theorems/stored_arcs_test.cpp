// What a store keeps is the same for every tile size, with and without a memory limit: the arcs are those of the contour tree, the voxels
// of an element are those that stop at it when they climb down the join tree, and events have as many as their zones.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <numeric>
#include <optional>

#include "analysis/analysis_data.h"
#include "analysis/contour_arcs.h"
#include "analysis/trees.h"
#include "base/memory_limit.h"
#include "critical/bodies.h"
#include "critical/grid_domain.h"
#include "field/volume_view.h"
#include "oracle/compare.h"
#include "oracle/volumes.h"
#include "tree/merge_tree.h"
#include "tree/predicates.h"
#include "zones/count_voxels.h"

namespace oracle {
namespace {

using Id = std::uint32_t;
using Arrays = isoatlas::AnalysisArrays<Id>;

isoatlas::Context context_of(int threads, Index tile) {
    isoatlas::Context context;
    context.threads = threads;
    context.slab_slices = tile;
    return context;
}

/// One voxel after the other.
std::vector<Id> climbed(const Grid& grid, isoatlas::Interpolant interpolant) {
    const isoatlas::GridView<double> view{grid.value.data(), {grid.rank, {grid.size}}};
    const double tunnel_height = isoatlas::tunnel_height_of(interpolant, 0);
    const auto [set, basin] = isoatlas::GridDomain<double, Id>(view, isoatlas::scan_grid(view, tunnel_height, {})).critical(true, {});
    const auto parent = isoatlas::join_tree(set);
    isoatlas::ElementsOfMaxima<Id> element_of_maximum(static_cast<std::size_t>(set.maxima));
    std::vector<Id> voxels(set.size(), 0);
    for (const auto i : set.code.ids()) {
        if (isoatlas::ElementCode{set.code[i]}.h0() == 0) element_of_maximum[set.up_a[i]] = i;
    }
    for (Index v = 0; v < grid.voxels(); ++v) {
        const isoatlas::MaximumIdOf<Id> maximum(isoatlas::Basins<Id>::number(basin[isoatlas::VoxelId(v)]));
        auto at = element_of_maximum[maximum];
        while (parent[at].index() < set.size() && set.value[parent[at]] >= grid.value[v]) at = parent[at];
        ++voxels[at.index()];
    }
    return voxels;
}

/// By tiles, which builds do when paths do not fit into memory.
std::vector<Id> counted_by_tiles(const isoatlas::Volume& volume, const isoatlas::ArcArrays<Id>& arrays, const isoatlas::Context& context) {
    return isoatlas::visit_samples(volume, [&]<class T>(std::span<const T> samples) {
        const isoatlas::GridView<T> grid{samples.data(), volume.info.extent};
        const auto voxels = isoatlas::voxels_by_tiles<T, Id>(grid, arrays.value, arrays.code, context);
        return std::vector<Id>(voxels.items().begin(), voxels.items().end());
    });
}

void check(const Grid& grid, isoatlas::Interpolant interpolant, isoatlas::ValueType type, const std::vector<Index>& tiles) {
    const isoatlas::Volume volume = to_volume(grid, type);
    const isoatlas::AnalysisOptions options{.interpolant = interpolant};
    const isoatlas::Analysis expected = isoatlas::analyse(volume, options, context_of(1, 0));
    const Arrays& arrays = std::get<0>(expected.data().arrays)->arrays;
    const std::vector<Id> voxels = climbed(grid, interpolant);
    for (const bool limited : {false, true}) {
        std::optional<isoatlas::MemoryLimit> limit;
        if (limited) limit.emplace(isoatlas::kMinMemory, testing::TempDir());
        for (const Index tile : tiles) {
            const isoatlas::Context context = context_of(1 + static_cast<int>(tile % 2), tile);
            isoatlas::ContourArcs arcs = isoatlas::compute_arcs(volume, options, context);
            const isoatlas::ElementVoxels all_counted = isoatlas::count_voxels(arcs, volume, context);
            const auto& counted = std::get<0>(all_counted);
            auto& found = std::get<0>(arcs.arrays);
            RC_ASSERT(found.value == arrays.value && found.code == arrays.code);
            RC_ASSERT(found.contours.other == arrays.contours.other);
            RC_ASSERT(std::ranges::equal(counted.items(), voxels));
            RC_ASSERT(counted_by_tiles(volume, found, context) == voxels);
            Arrays restored;
            restored.value = found.value, restored.code = found.code, restored.contours = found.contours;
            RC_ASSERT(isoatlas::restore_trees(restored, grid.rank, context_of(1, 0)));
            isoatlas::add_up_voxels<Id>(counted, restored);
            RC_ASSERT(restored.voxels == arrays.voxels);
            if (*rc::gen::arbitrary<bool>()) found.element = {};  // as a build that goes on from its trees
            const isoatlas::Analysis made = isoatlas::make_analysis(std::move(arcs), all_counted, volume, context);
            RC_ASSERT(std::get<0>(made.data().arrays)->arrays.zone == arrays.zone);
            RC_ASSERT(std::get<0>(made.data().arrays)->arrays.voxels == arrays.voxels);
        }
    }
}

// What a damaged store may say: any tree of any elements. It is refused, or its trees have all properties of trees.
void any_arcs_are_refused_or_give_trees() {
    Arrays arrays;
    const auto n = *rc::gen::inRange<Id>(1, 12);
    const auto rank = *rc::gen::element(2, 3);
    int chi = 0;
    double value = 20;
    for (Id i = 0; i < n; ++i) {
        int h0 = *rc::gen::inRange(0, 3), l0 = *rc::gen::inRange(0, 3);
        if (i + 1 == n && rank == 3 && std::abs(1 - chi) < 3) h0 = std::max(0, chi - 1), l0 = std::max(0, 1 - chi);  // of a box
        chi += l0 - h0;
        arrays.code.push_back(isoatlas::ElementCode::vertex(i, h0, l0, 0).bits);
        arrays.value.push_back(value -= *rc::gen::inRange(0, 2));
    }
    using Element = isoatlas::ElementIdOf<Id>;
    const Element outside(n);
    std::vector<Element> order, inside{outside};
    for (const Element i : isoatlas::IdRange<Element>(n)) order.push_back(i);
    arrays.contours.other.items().resize(n + 1);
    arrays.contours.other[outside] = outside;
    for (Id i = 0; i < n; ++i) {
        std::swap(order[i], order[*rc::gen::inRange<Id>(i, n)]);
        arrays.contours.other[order[i]] = inside[*rc::gen::inRange<std::size_t>(0, inside.size())];
        inside.push_back(order[i]);
    }
    if (!isoatlas::restore_trees(arrays, rank, context_of(1, 0))) return;
    RC_ASSERT(isoatlas::is_contour_tree(arrays.contours));
    RC_ASSERT(isoatlas::every_level_has_one_value<Id>(arrays.contours, arrays.level, arrays.value));
    RC_ASSERT(isoatlas::every_event_has_its_zone<Id>(arrays.tree, arrays.value));
}

void stored_arcs_give_the_trees_of_small_volumes_back() {
    check(*arbitrary_grid(7, 200), *arbitrary_interpolant(), isoatlas::ValueType::f64, {0, 1, 2, 3, 5});
}

void stored_arcs_give_the_trees_of_larger_volumes_back() {
    if (*rc::gen::inRange(0, 20) != 0) return;  // they cost more
    check(*arbitrary_grid(14, 2000), *arbitrary_interpolant(), isoatlas::ValueType::f64, {2, 3, 4, 8});
}

// Values of few bits are counted instead of sorted.
void stored_arcs_give_the_trees_of_integers_back() {
    Grid grid = *arbitrary_grid(7, 200);
    for (double& value : grid.value) value = std::round(value / 4) - 20;
    check(grid, *arbitrary_interpolant(), *rc::gen::element(isoatlas::ValueType::i8, isoatlas::ValueType::i16, isoatlas::ValueType::f32),
          {0, 2, 3});
}

RC_GTEST_PROP(StoredArcs, GiveTheTreesOfSmallVolumesBack, ()) { stored_arcs_give_the_trees_of_small_volumes_back(); }
RC_GTEST_PROP(StoredArcs, GiveTheTreesOfLargerVolumesBack, ()) { stored_arcs_give_the_trees_of_larger_volumes_back(); }
RC_GTEST_PROP(StoredArcs, GiveTheTreesOfIntegersBack, ()) { stored_arcs_give_the_trees_of_integers_back(); }
RC_GTEST_PROP(StoredArcs, OfDamagedStoresAreRefusedOrGiveTrees, ()) { any_arcs_are_refused_or_give_trees(); }

}  // namespace
}  // namespace oracle
