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
#include "critical/basins.h"
#include "critical/elements_with_extrema.h"
#include "critical/partitioned_domain.h"
#include "tree/assemble.h"
#include "zones/count_voxels.h"

namespace isoatlas {
namespace {

/// When memory is short: nothing is accessed at random but a tile at a time.
template <class Id>
ArcArrays<Id> arcs_by_tiles(const Extent& extent, GridScan scan, const Context& context) {
    PartitionedCriticals<Id> criticals = parted_criticals<Id>(extent, std::move(scan), tiling_for(extent, context), context);
    report(context, kAnalysisPhases["trees"], 0);
    ArcArrays<Id> arcs{std::move(criticals.value), std::move(criticals.code), {}, {}};
    arcs.contours.other = contour_arcs<Id>(std::move(criticals.set), criticals.part_of, context);
    return arcs;
}

template <class T, class Id>
ArcArrays<Id> arcs_at_once(const GridView<T>& grid, GridScan scan, const Context& context) {
    Criticals<Id> criticals = GridDomain<T, Id>(grid, std::move(scan)).critical(true, context);
    report(context, kAnalysisPhases["trees"], 0);
    AnalysisArrays<Id> arrays;
    make_arcs(std::move(criticals.set), arrays, context.threads);
    return {std::move(arrays.value), std::move(arrays.code), {std::move(arrays.contours.other), {}, {}}, std::move(criticals.basin)};
}

/// Is every basin that of a maximum, and does every object begin at one? HeavyPathDecomposition relies on it.
template <class Id>
bool fit(const AnalysisArrays<Id>& arrays, std::span<const Id> basin, const Extent& extent) {
    BudgetPoll memory;
    const auto is_maximum = [&](std::uint64_t code) { return memory.step(sizeof code), ElementCode{code}.h0() == 0; };
    const BigVector<Id> maxima = elements_of_maxima<Id>(arrays.code, extent);
    if (static_cast<std::size_t>(std::ranges::count_if(arrays.code, is_maximum)) != maxima.size()) return false;  // one voxel twice
    const auto exists = [&](Id entry) { return memory.step(sizeof(Id)), Basins<Id>::number(entry) < maxima.size(); };
    if (!std::ranges::all_of(basin, exists)) return false;
    std::vector<bool> is_reached(arrays.tree.size(), false);
    for (std::size_t e = 0; e < arrays.tree.size(); ++e) {
        memory.step(2 * BudgetPoll::kTouch);
        if (!is_reached[e] && !is_maximum(arrays.code[arrays.tree.top[e]])) return false;
        is_reached[arrays.tree.parent[e]] = true;  // parents come after their children
    }
    return true;
}

/// basin: empty when it is not known.
template <class Id>
bool find_zones(const VolumeView& volume, BigVector<Id> basin, AnalysisArrays<Id>& arrays, const Context& context) {
    return visit_samples(volume, [&]<class T>(std::span<const T> samples) {
        const GridView<T> grid{samples.data(), volume.info->extent};
        if (basin.empty()) basin = basins_of_maxima<Id>(grid.extent, links_of_grid(grid, context), context);
        if (!fit<Id>(arrays, basin, grid.extent)) return false;
        make_zones(GridDomain<T, Id>(grid, {}), std::move(basin), arrays, context);
        return true;
    });
}

template <class Id>
BigVector<Id> count(ArcArrays<Id>& arcs, const VolumeView& volume, const Context& context) {
    return visit_samples(volume, [&]<class T>(std::span<const T> samples) {
        const GridView<T> grid{samples.data(), volume.info->extent};
        if (!paths_fit(arcs.code.size())) {
            release(arcs.basin);
            return voxels_by_tiles<T, Id>(grid, arcs.value, arcs.code, context);
        }
        if (arcs.basin.empty()) arcs.basin = basins_of_maxima<Id>(grid.extent, links_of_grid(grid, context), context);
        return voxels_by_paths<T, Id>(grid, arcs.value, arcs.code, arcs.contours, arcs.basin, context);
    });
}

}  // namespace

ContourArcs compute_arcs(const VolumeView& volume, const AnalysisOptions& options, const Context& context) {
    ContourArcs arcs{volume.info->extent, options.interpolant, options.tunnel_height, {}};
    with_scan(volume, options, context, [&]<class T, class Id>(const GridView<T>& grid, GridScan scan, Id) {
        if (memory_is_limited()) {
            arcs.arrays = arcs_by_tiles<Id>(grid.extent, std::move(scan), context);
        } else {
            arcs.arrays = arcs_at_once<T, Id>(grid, std::move(scan), context);
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
    const auto restore = [&]<class Id>(ArcArrays<Id>& held) {
        auto whole = std::make_unique<IndexedArrays<Id>>();
        AnalysisArrays<Id>& arrays = whole->arrays;
        arrays.value = std::move(held.value), arrays.code = std::move(held.code), arrays.contours = std::move(held.contours);
        const bool is_tree = restore_trees(arrays, arcs.extent.rank, context);
        data->arrays = std::move(whole);
        return is_tree;
    };
    if (!std::visit(restore, arcs.arrays)) return std::nullopt;
    return Analysis(std::move(data));
}

Analysis make_analysis(ContourArcs arcs, const VolumeView& volume, const Context& context) {
    std::optional<Analysis> analysis = restored_trees(arcs, context);
    ISOATLAS_CHECK(analysis.has_value());
    ISOATLAS_CHECK(analysis->data().visit([&]<class Id>(IndexedArrays<Id>& held) {
        return find_zones(volume, std::move(std::get<ArcArrays<Id>>(arcs.arrays).basin), held.arrays, context);
    }));
    return std::move(*analysis);
}

bool add_zones(Analysis& analysis, const VolumeView& volume, const Context& context) {
    return analysis.data().visit([&]<class Id>(IndexedArrays<Id>& held) { return find_zones<Id>(volume, {}, held.arrays, context); });
}

}  // namespace isoatlas
