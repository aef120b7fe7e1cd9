// The engine from samples to zones: the flow of the whole library in one function.
#include <algorithm>
#include <utility>

#include "base/check.h"
#include "base/parallel.h"
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

template <class Id>
std::vector<std::int8_t> delta_chis(const CriticalSet<Id>& set) {
    std::vector<std::int8_t> delta(set.size());
    for (std::size_t i = 0; i < delta.size(); ++i) delta[i] = static_cast<std::int8_t>(delta_chi(ElementCode{set.code[i]}, set.rank));
    return delta;
}

/// Contours of a 2D grid are circles: genus 0 whatever happens.
template <class Id>
ContourTree<Id> circles(ContourTree<Id> tree) {
    std::fill(tree.half_chi.begin(), tree.half_chi.end(), 1);
    return tree;
}

/// The event at which the ascending path of each maximum's basin starts, as a place on its heavy path.
template <class Id>
std::vector<typename HeavyPaths<Id>::Place> starts_of_maxima(const CriticalSet<Id>& set, std::span<const Id> maximum_of,
                                                             const CriticalityTree<Id>& tree, const HeavyPaths<Id>& paths) {
    std::vector<typename HeavyPaths<Id>::Place> start(static_cast<std::size_t>(set.maxima));
    for (std::size_t i = 0; i < set.size(); ++i) {
        if (ElementCode{set.code[i]}.h0() == 0) start[maximum_of[i]] = paths.place(tree.event_of_element[i]);
    }
    return start;
}

template <class T, class Id>
void make_zones(const GridView<T>& grid, const CriticalSet<Id>& set, std::vector<Id> basin, AnalysisArrays<Id>& arrays, const Context& context) {
    const HeavyPaths<Id> paths(arrays.tree, set.value);
    const auto start = starts_of_maxima<Id>(set, set.up_a, arrays.tree, paths);
    arrays.voxels.assign(arrays.tree.size(), Id{0});
    const std::int64_t height = slab_height(grid.extent, context), slabs = (grid.extent.size[2] + height - 1) / height;
    for_each_block(context.threads, slabs, [&](std::int64_t i) {
        const Slab slab = slab_at(i, height, grid.extent.size[2]);
        const std::size_t first = slab.z_begin * grid.extent.slice(), count = (slab.z_end - slab.z_begin) * grid.extent.slice();
        label_zones<T, Id>({grid.samples + first, count}, paths, start, std::span<Id>(basin).subspan(first, count), arrays.voxels);
    });
    arrays.zone = std::move(basin);
    arrays.object_voxels = arrays.voxels;
    for (std::size_t e = 0; e < arrays.tree.size(); ++e) {
        if (!arrays.tree.is_root(e)) arrays.object_voxels[arrays.tree.parent[e]] += arrays.object_voxels[e];
    }
}

template <class T, class Id>
std::unique_ptr<IndexedArrays<Id>> run(const GridView<T>& grid, const AnalysisOptions& options, const Context& context) {
    Criticals<Id> criticals = GridDomain<T, Id>(grid).critical(context);
    CriticalSet<Id>& set = criticals.set;
    context.report("trees", 3, kPhases, 0);
    std::vector<Id> join, split;
    run_both(context.threads, [&] { join = join_tree(set); }, [&] { split = split_tree(set); });
    if (!options.zones) set.up_a = {};
    set.up_b = {}, set.low_a = {}, set.low_b = {};

    auto result = std::make_unique<IndexedArrays<Id>>();
    AnalysisArrays<Id>& arrays = result->arrays;
    const std::vector<std::int8_t> delta = delta_chis(set);
    const bool is_3d = grid.is_3d();
    arrays.contours = contour_tree<Id>(join, std::move(split), is_3d ? std::span<const std::int8_t>(delta) : std::span<const std::int8_t>());
    if (!is_3d) arrays.contours = circles(std::move(arrays.contours));
    Levels<Id> levels = contract_levels<Id>(arrays.contours, set.value);
    arrays.tree = criticality_tree<Id>(join, levels, set.value, delta);
    arrays.level = std::move(levels.root);
    join = {};
    levels = {};
    context.report("zones", 4, kPhases, 0);
    if (options.zones) make_zones(grid, set, std::move(criticals.basin), arrays, context);
    arrays.value = std::move(set.value);
    arrays.code = std::move(set.code);
    context.report("zones", 4, kPhases, 1);
    return result;
}

}  // namespace

Analysis analyse(const Volume& volume, const AnalysisOptions& options, const Context& context) {
    auto data = std::make_unique<Analysis::Data>();
    data->extent = volume.info.extent;
    data->interpolant = options.interpolant;
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
    return Analysis(std::move(data));
}

}  // namespace isoatlas
