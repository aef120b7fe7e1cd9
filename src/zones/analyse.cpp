// The engine from samples to zones: the flow of the whole library in one function.
#include <algorithm>
#include <utility>

#include "base/check.h"
#include "base/parallel.h"
#include "critical/bodies.h"
#include "critical/grid_domain.h"
#include "tree/contour_tree.h"
#include "tree/criticality_tree.h"
#include "tree/levels.h"
#include "tree/merge_tree.h"
#include "zones/analysis_data.h"
#include "zones/label.h"
#include "zones/paths.h"

namespace isoatlas {
namespace {

constexpr int kPhases = 5;

BigVector<std::int8_t> delta_chis(std::span<const std::uint64_t> code, int rank) {
    BigVector<std::int8_t> delta(code.size());
    for (std::size_t i = 0; i < delta.size(); ++i) delta[i] = static_cast<std::int8_t>(delta_chi(ElementCode{code[i]}, rank));
    return delta;
}

/// Contours of a 2D grid are circles: genus 0 whatever happens.
template <class Id>
ContourTree<Id> circles(ContourTree<Id> tree) {
    std::fill(tree.half_chi.begin(), tree.half_chi.end(), 1);
    return tree;
}

/// Per maximum: its critical element.
template <class Id>
BigVector<Id> elements_of_maxima(const CriticalSet<Id>& set) {
    BigVector<Id> element(static_cast<std::size_t>(set.maxima));
    for (std::size_t i = 0; i < set.size(); ++i) {
        if (ElementCode{set.code[i]}.h0() == 0) element[set.up_a[i]] = static_cast<Id>(i);
    }
    return element;
}

/// Zones of all voxels and their sizes. maxima: their elements. The basins become the zones in place.
template <class T, class Id>
void make_zones(const GridView<T>& grid, BigVector<Id> maxima, BigVector<Id> basin, AnalysisArrays<Id>& arrays, const Context& context) {
    const HeavyPaths<Id, ComparisonValue<T>> paths(arrays.tree, arrays.value, maxima, context.threads);
    release(maxima);
    arrays.voxels.assign(arrays.tree.size(), Id{0});
    const std::int64_t height = slab_height(grid.extent, context), slabs = (grid.extent.size[2] + height - 1) / height;
    for_each_block(context.threads, slabs, [&](std::int64_t i) {
        const Slab slab = slab_at(i, height, grid.extent.size[2]);
        const std::size_t first = slab.z_begin * grid.extent.slice(), count = (slab.z_end - slab.z_begin) * grid.extent.slice();
        label_zones<T, Id>({grid.samples + first, count}, paths, std::span<Id>(basin).subspan(first, count), arrays.voxels);
    });
    arrays.zone = std::move(basin);
}

/// Criticality tree, contour tree and genus from the critical elements alone. Returns the kinds of the levels.
template <class Id>
BigVector<LevelKind> make_trees(CriticalSet<Id> set, AnalysisArrays<Id>& arrays, int threads) {
    BigVector<Id> join, split;
    run_both(threads, [&] { join = join_tree(set); }, [&] { split = split_tree(set); });
    for (BigVector<Id>* field : {&set.up_a, &set.up_b, &set.low_a, &set.low_b}) release(*field);
    const bool is_3d = set.rank == 3;
    const BigVector<std::int8_t> delta = is_3d ? delta_chis(set.code, 3) : BigVector<std::int8_t>();
    arrays.contours = contour_tree<Id>(join, std::move(split), delta, threads);
    if (!is_3d) arrays.contours = circles(std::move(arrays.contours));
    arrays.value = std::move(set.value);
    arrays.code = std::move(set.code);
    BigVector<Id> group;
    run_both(
        threads, [&] { arrays.level = level_roots<Id>(arrays.contours, arrays.value); },
        [&] { group = join_groups<Id>(join, arrays.value); });
    BigVector<LevelKind> kind = level_kinds<Id>(arrays.contours, arrays.level, arrays.value, delta);
    arrays.tree = criticality_tree<Id>(std::move(group), join, arrays.level, kind);
    return kind;
}

template <class T, class Id>
std::unique_ptr<IndexedArrays<Id>> run(const GridView<T>& grid, const AnalysisOptions& options, const Context& context) {
    auto result = std::make_unique<IndexedArrays<Id>>();
    AnalysisArrays<Id>& arrays = result->arrays;
    Criticals<Id> criticals = GridDomain<T, Id>(grid, tunnel_height_of(options.interpolant, options.tunnel_height)).critical(context);
    BigVector<Id> maxima = options.zones ? elements_of_maxima(criticals.set) : BigVector<Id>();
    if (!options.zones) release(criticals.basin);
    context.report("trees", 3, kPhases, 0);
    const BigVector<LevelKind> kind = make_trees(std::move(criticals.set), arrays, context.threads);
    context.report("zones", 4, kPhases, 0);
    if (options.zones) make_zones<T, Id>(grid, std::move(maxima), std::move(criticals.basin), arrays, context);
    arrays.measures =
        measure_events<Id>(arrays.tree, arrays.contours, arrays.level, kind, delta_chis(arrays.code, grid.extent.rank), context.threads);
    context.report("zones", 4, kPhases, 1);
    return result;
}

}  // namespace

Analysis analyse(const Volume& volume, const AnalysisOptions& options, const Context& context) {
    auto data = std::make_unique<Analysis::Data>();
    data->extent = volume.info.extent;
    data->interpolant = options.interpolant;
    data->tunnel_height = options.tunnel_height;
    ISOATLAS_CHECK(static_cast<std::int64_t>(volume.bytes.size() / size_of(volume.info.type)) == volume.info.extent.voxels());
    visit_samples(volume, [&]<class T>(std::span<const T> samples) {
        const GridView<T> grid{samples.data(), volume.info.extent};
        // 32 bits for voxels, critical elements (at most 4 a voxel) and sums of Euler numbers while they are certain to fit.
        if (volume.info.extent.voxels() < std::int64_t{1} << 29) {
            data->arrays = run<T, std::uint32_t>(grid, options, context);
        } else {
            data->arrays = run<T, std::uint64_t>(grid, options, context);
        }
    });
    return_big_memory();
    return Analysis(std::move(data));
}

}  // namespace isoatlas
