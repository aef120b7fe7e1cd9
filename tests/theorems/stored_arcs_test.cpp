// What a store keeps is the same for every tile size, with and without a memory limit: the arcs are those of the contour tree, the voxels
// of an element are those that stop at it when they climb down the join tree, and events have as many as their zones.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <optional>

#include "analysis/analyse.h"
#include "analysis/analysis_data.h"
#include "analysis/trees.h"
#include "base/memory_limit.h"
#include "critical/bodies.h"
#include "critical/grid_domain.h"
#include "field/volume_view.h"
#include "oracle/compare.h"
#include "oracle/volumes.h"
#include "tree/merge_tree.h"
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
    const isoatlas::GridView<double> view{grid.value.data(), {grid.rank, grid.size}};
    const double tunnel_height = isoatlas::tunnel_height_of(interpolant, 0);
    const auto [set, basin] = isoatlas::GridDomain<double, Id>(view, isoatlas::scan_grid(view, tunnel_height, {})).critical(true, {});
    const auto parent = isoatlas::join_tree(set);
    std::vector<Id> element_of_maximum(static_cast<std::size_t>(set.maxima)), voxels(set.size(), 0);
    for (Id i = 0; i < set.size(); ++i) {
        if (isoatlas::ElementCode{set.code[i]}.h0() == 0) element_of_maximum[set.up_a[i]] = i;
    }
    for (Index v = 0; v < grid.voxels(); ++v) {
        Id at = element_of_maximum[isoatlas::Basins<Id>::number(basin[v])];
        while (parent[at] < set.size() && set.value[parent[at]] >= grid.value[v]) at = parent[at];
        ++voxels[at];
    }
    return voxels;
}

struct Stored {
    isoatlas::Analysis analysis;
    Stored(const isoatlas::Volume& volume, const isoatlas::AnalysisOptions& options, const isoatlas::Context& context)
        : analysis(isoatlas::find_arcs(volume, options, context)) {
        isoatlas::count_voxels(analysis, volume, context);
    }
    Arrays& arrays() { return std::get<0>(analysis.data().arrays)->arrays; }
};

/// By tiles, which builds do when paths do not fit into memory.
std::vector<Id> counted_by_tiles(const isoatlas::Volume& volume, const Arrays& arrays, const isoatlas::Context& context) {
    return isoatlas::visit_samples(volume, [&]<class T>(std::span<const T> samples) {
        const isoatlas::GridView<T> grid{samples.data(), volume.info.extent};
        const auto voxels = isoatlas::voxels_by_tiles<T, Id>(grid, arrays.value, arrays.code, context);
        return std::vector<Id>(voxels.begin(), voxels.end());
    });
}

template <class A, class B>
bool same(const A& a, const B& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end());
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
            Stored stored(volume, options, context_of(1 + static_cast<int>(tile % 2), tile));
            Arrays& found = stored.arrays();
            RC_ASSERT(same(found.value, arrays.value) && same(found.code, arrays.code));
            RC_ASSERT(same(found.contours.other, arrays.contours.other));
            RC_ASSERT(same(found.element_voxels, voxels));
            RC_ASSERT(same(counted_by_tiles(volume, found, context_of(1 + static_cast<int>(tile % 2), tile)), voxels));
            RC_ASSERT(isoatlas::restore_trees(found, grid.rank, context_of(1, 0)));
            isoatlas::add_up_voxels(found);
            RC_ASSERT(same(found.voxels, arrays.voxels));
        }
    }
}

RC_GTEST_PROP(StoredArcs, OfSmallVolumes, ()) {
    check(*arbitrary_grid(7, 200), *arbitrary_interpolant(), isoatlas::ValueType::f64, {0, 1, 2, 3, 5});
}

RC_GTEST_PROP(StoredArcs, OfLargerVolumes, ()) {
    if (*rc::gen::inRange(0, 20) != 0) return;  // they cost more
    check(*arbitrary_grid(14, 2000), *arbitrary_interpolant(), isoatlas::ValueType::f64, {2, 3, 4, 8});
}

// Values of few bits are counted instead of sorted.
RC_GTEST_PROP(StoredArcs, OfIntegers, ()) {
    Grid grid = *arbitrary_grid(7, 200);
    for (double& value : grid.value) value = std::round(value / 4) - 20;
    check(grid, *arbitrary_interpolant(), *rc::gen::element(isoatlas::ValueType::i8, isoatlas::ValueType::i16, isoatlas::ValueType::f32),
          {0, 2, 3});
}

}  // namespace
}  // namespace oracle
