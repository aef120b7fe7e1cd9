#include "analysis/contour_arcs.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "analysis/analyse_domain.h"
#include "analysis/analysis_data.h"
#include "analysis/grid_scanner.h"
#include "analysis/trees.h"
#include "base/check.h"
#include "base/memory_limit.h"
#include "base/parallel.h"
#include "base/streamed.h"
#include "critical/basins.h"
#include "critical/elements_with_extrema.h"
#include "critical/partitioned_domain.h"
#include "tree/assemble.h"
#include "zones/count_voxels.h"

namespace isoatlas {
namespace {

/// When memory is short: nothing is accessed at random but a tile at a time.
template <class Number>
ArcArrays<Number> arcs_by_tiles(const Extent& extent, GridScan scan, const Context& context) {
    PartitionedCriticals<Number> criticals = parted_criticals<Number>(extent, std::move(scan), tiling_for(extent, context), context);
    report(context, kAnalysisPhases["trees"], 0);
    ArcArrays<Number> arcs{std::move(criticals.value), std::move(criticals.code), {}, {}};
    arcs.contours.other = contour_arcs<Number>(std::move(criticals.set), criticals.part_of, context);
    return arcs;
}

template <class T, class Number>
ArcArrays<Number> arcs_at_once(const GridView<T>& grid, GridScan scan, const Context& context) {
    Criticals<Number> criticals = GridDomain<T, Number>(grid, std::move(scan)).critical(true, context);
    report(context, kAnalysisPhases["trees"], 0);
    AnalysisArrays<Number> arrays;
    make_arcs(std::move(criticals.set), arrays, context.threads);
    return {std::move(arrays.value), std::move(arrays.code), {std::move(arrays.contours.other), {}, {}}, std::move(criticals.basin)};
}

/// Is every basin that of a maximum, and does every object begin at one? HeavyPathDecomposition relies on it.
template <class Number>
bool fit(const AnalysisArrays<Number>& arrays, ByVoxelView<Number, Number> basin, const Extent& extent) {
    const auto is_maximum = [&](ElementIdOf<Number> x) { return ElementCode{arrays.code[x]}.h0() == 0; };
    const std::size_t maxima = elements_of_maxima<Number>(arrays.code, extent).size();
    std::size_t count = 0;
    for (const auto x : streamed<ElementIdOf<Number>>(arrays.code.size(), in_order(1))) count += is_maximum(x);
    if (count != maxima) return false;  // one voxel twice
    for (const auto v : streamed<VoxelIdOf<Number>>(basin.size(), {sizeof(Number)})) {
        if (Basins<Number>::number(basin[v]) >= maxima) return false;
    }
    std::vector<bool> is_reached(arrays.tree.size(), false);
    for (const auto e : streamed<EventIdOf<Number>>(arrays.tree.size(), at_random(2))) {
        if (!is_reached[e.index()] && !is_maximum(arrays.tree.top[e])) return false;
        is_reached[arrays.tree.parent[e].index()] = true;  // parents come after their children
    }
    return true;
}

template <class Number>
bool find_zones(const VolumeView& volume, AnalysisArrays<Number>& arrays, const Context& context) {
    return visit_samples(volume, [&]<class T>(std::span<const T> samples) {
        const GridView<T> grid{samples.data(), volume.info->extent};
        ByVoxel<Number, Number> basin;
        basin.items() = basins_of_maxima<Number>(grid.extent, links_of_grid(grid, context), context);
        if (!fit<Number>(arrays, basin, grid.extent)) return false;
        make_zones(GridDomain<T, Number>(grid, {}), std::move(basin), arrays, context);
        return true;
    });
}

/// The zone of every voxel is that of the event of its element.
template <class Number>
void take_zones(ByVoxel<Number, Number> element, const ElementVoxels& voxels, AnalysisArrays<Number>& arrays, int threads) {
    std::span<Number> to_zone = element.items();
    for_each_index(threads, to_zone.size(),
                   [&](std::size_t v) { to_zone[v] = arrays.tree.event_of_element[ElementIdOf<Number>(to_zone[v])].number(); });
    arrays.zone = std::move(element);
    add_up_voxels<Number>(std::get<ByElement<Number, Number>>(voxels), arrays);
}

template <class Number>
ByElement<Number, Number> count(ArcArrays<Number>& arcs, const VolumeView& volume, const Context& context) {
    return visit_samples(volume, [&]<class T>(std::span<const T> samples) {
        const GridView<T> grid{samples.data(), volume.info->extent};
        if (!paths_fit(arcs.code.size())) {
            release(arcs.basin.items());
            return voxels_by_tiles<T, Number>(grid, arcs.value, arcs.code, context);
        }
        if (arcs.basin.empty()) arcs.basin.items() = basins_of_maxima<Number>(grid.extent, links_of_grid(grid, context), context);
        ByElement<Number, Number> voxels =
            voxels_by_paths<T, Number>(grid, arcs.value, arcs.code, arcs.contours, arcs.basin.items(), context);
        arcs.element = std::move(arcs.basin);
        return voxels;
    });
}

}  // namespace

ContourArcs compute_arcs(const VolumeView& volume, const AnalysisOptions& options, const Context& context) {
    ContourArcs arcs{volume.info->extent, options.interpolant, options.tunnel_height, {}};
    with_scan(volume, options, context, [&]<class T, class Number>(const GridView<T>& grid, GridScan scan, Number) {
        if (memory_is_limited()) {
            arcs.arrays = arcs_by_tiles<Number>(grid.extent, std::move(scan), context);
        } else {
            arcs.arrays = arcs_at_once<T, Number>(grid, std::move(scan), context);
        }
    });
    return arcs;
}

ElementVoxels count_voxels(ContourArcs& arcs, const VolumeView& volume, const Context& context) {
    report(context, kAnalysisPhases["zones"], 0);
    ElementVoxels voxels = std::visit([&](auto& held) { return ElementVoxels(count(held, volume, context)); }, arcs.arrays);
    report(context, kAnalysisPhases["zones"], 1);
    return voxels;
}

std::optional<Analysis> restored_trees(ContourArcs& arcs, const Context& context) {
    auto data = std::make_unique<Analysis::Data>();
    data->extent = arcs.extent, data->interpolant = arcs.interpolant, data->tunnel_height = arcs.tunnel_height;
    const auto restore = [&]<class Number>(ArcArrays<Number>& held) {
        auto whole = std::make_unique<IndexedArrays<Number>>();
        AnalysisArrays<Number>& arrays = whole->arrays;
        arrays.value = std::move(held.value), arrays.code = std::move(held.code), arrays.contours = std::move(held.contours);
        const bool is_tree = restore_trees(arrays, arcs.extent.rank, context);
        data->arrays = std::move(whole);
        return is_tree;
    };
    if (!std::visit(restore, arcs.arrays)) return std::nullopt;
    return Analysis(std::move(data));
}

Analysis make_analysis(ContourArcs arcs, const ElementVoxels& voxels, const VolumeView& volume, const Context& context) {
    std::optional<Analysis> analysis = restored_trees(arcs, context);
    ISOATLAS_CHECK(analysis.has_value());
    analysis->data().visit([&]<class Number>(IndexedArrays<Number>& held) {
        ByVoxel<Number, Number>& element = std::get<ArcArrays<Number>>(arcs.arrays).element;
        if (element.empty()) {
            ISOATLAS_CHECK(find_zones<Number>(volume, held.arrays, context));
        } else {
            take_zones<Number>(std::move(element), voxels, held.arrays, context.threads);
        }
    });
    return std::move(*analysis);
}

bool add_zones(Analysis& analysis, const VolumeView& volume, const Context& context) {
    return analysis.data().visit(
        [&]<class Number>(IndexedArrays<Number>& held) { return find_zones<Number>(volume, held.arrays, context); });
}

}  // namespace isoatlas
