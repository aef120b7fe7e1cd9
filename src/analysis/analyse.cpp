// The engine from samples to zones: the flow of the whole library on one page.
#include "analysis/analyse.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "analysis/analysis_data.h"
#include "analysis/trees.h"
#include "base/check.h"
#include "base/memory_limit.h"
#include "base/paced_fill.h"
#include "critical/basins.h"
#include "critical/bodies.h"
#include "critical/elements_with_extrema.h"
#include "critical/grid_domain.h"
#include "critical/partitioned_domain.h"
#include "field/slab_work.h"
#include "tree/assemble.h"
#include "tree/heavy_paths.h"
#include "zones/count_voxels.h"
#include "zones/label.h"

namespace isoatlas {
namespace {

constexpr int kPhases = 5;

/// 32 bits for voxels, critical elements and sums of Euler numbers while they are certain to fit.
bool fits_32_bits(const Extent& extent, const GridScan& scan) {
    return extent.voxels() < std::int64_t{1} << 31 && scan.elements < std::int64_t{1} << 30;
}

/// The basins stay in arrays.zone for the zones.
template <class T, class Id>
CriticalSet<Id> critical_set(const GridView<T>& grid, GridScan scan, AnalysisArrays<Id>& arrays, const Context& context) {
    Criticals<Id> criticals = GridDomain<T, Id>(grid, std::move(scan)).critical(true, context);
    arrays.zone = std::move(criticals.basin);
    context.report("trees", 3, kPhases, 0);
    return std::move(criticals.set);
}

/// Value, code and arcs when memory is short: nothing is accessed at random but a tile at a time.
template <class Id>
void make_arcs_by_tiles(const Extent& extent, GridScan scan, AnalysisArrays<Id>& arrays, const Context& context) {
    PartitionedCriticals<Id> criticals = parted_criticals<Id>(extent, std::move(scan), tiling_for(extent, context), context);
    context.report("trees", 3, kPhases, 0);
    arrays.value = std::move(criticals.value);
    arrays.code = std::move(criticals.code);
    arrays.contours.other = contour_arcs<Id>(std::move(criticals.set), criticals.part_of, context);
}

/// The basins in arrays.zone become zones in place.
template <class T, class Id>
void make_zones(const GridView<T>& grid, AnalysisArrays<Id>& arrays, const Context& context) {
    BigVector<Id> maxima = elements_of_maxima<Id>(arrays.code, grid.extent);
    const CriticalityTree<Id>& tree = arrays.tree;
    const HeavyPathDecomposition<Id, ComparisonValue<T>> paths({tree.parent, arrays.value, tree.top, tree.event_of_element}, maxima,
                                                               context.threads);
    release(maxima);
    fill_fresh(arrays.voxels, arrays.tree.size(), Id{0});
    for_each_slab_of(slab_height(grid.extent, context), context, {"zones", 4, kPhases}, grid.extent.size[2], [&](const Slab& slab) {
        const std::size_t first = slab.z_begin * grid.extent.slice(), count = (slab.z_end - slab.z_begin) * grid.extent.slice();
        label_zones<T, Id>({grid.samples + first, count}, paths, std::span<Id>(arrays.zone).subspan(first, count), arrays.voxels);
    });
}

/// Is every basin (arrays.zone) that of a maximum, and does every object begin at one? HeavyPathDecomposition relies on it.
template <class Id>
bool fit(const AnalysisArrays<Id>& arrays, const Extent& extent) {
    BudgetPoll memory;
    const auto is_maximum = [&](std::uint64_t code) { return memory.step(sizeof code), ElementCode{code}.h0() == 0; };
    const BigVector<Id> maxima = elements_of_maxima<Id>(arrays.code, extent);
    if (static_cast<std::size_t>(std::ranges::count_if(arrays.code, is_maximum)) != maxima.size()) return false;  // one voxel twice
    const auto exists = [&](Id entry) { return memory.step(sizeof(Id)), Basins<Id>::number(entry) < maxima.size(); };
    if (!std::ranges::all_of(arrays.zone, exists)) return false;
    std::vector<bool> is_reached(arrays.tree.size(), false);
    for (std::size_t e = 0; e < arrays.tree.size(); ++e) {
        memory.step(2 * BudgetPoll::kTouch);
        if (!is_reached[e] && !is_maximum(arrays.code[arrays.tree.top[e]])) return false;
        is_reached[arrays.tree.parent[e]] = true;  // parents come after their children
    }
    return true;
}

/// Calls find(grid, scan, arrays) with arrays of the width that fits, and makes an analysis of them.
template <class Find>
Analysis analyse_with(const VolumeView& volume, const AnalysisOptions& options, const Context& context, const Find& find) {
    auto data = std::make_unique<Analysis::Data>();
    data->extent = volume.info->extent;
    data->interpolant = options.interpolant;
    data->tunnel_height = options.tunnel_height;
    visit_samples(volume, [&]<class T>(std::span<const T> samples) {
        const GridView<T> grid{samples.data(), data->extent};
        context.report("classify", 0, kPhases, 0);
        GridScan scan = scan_grid(grid, tunnel_height_of(options.interpolant, options.tunnel_height), context);
        const auto find_with = [&]<class Id>(std::unique_ptr<IndexedArrays<Id>> held) {
            find(grid, std::move(scan), held->arrays);
            data->arrays = std::move(held);
        };
        if (fits_32_bits(data->extent, scan)) {
            find_with(std::make_unique<IndexedArrays<std::uint32_t>>());
        } else {
            find_with(std::make_unique<IndexedArrays<std::uint64_t>>());
        }
    });
    return Analysis(std::move(data));
}

}  // namespace

Analysis find_arcs(const VolumeView& volume, const AnalysisOptions& options, const Context& context) {
    return analyse_with(volume, options, context,
                        [&]<class T, class Id>(const GridView<T>& grid, GridScan scan, AnalysisArrays<Id>& arrays) {
                            if (memory_is_limited()) return make_arcs_by_tiles(grid.extent, std::move(scan), arrays, context);
                            make_arcs(critical_set(grid, std::move(scan), arrays, context), arrays, context.threads);
                        });
}

void count_voxels(Analysis& analysis, const VolumeView& volume, const Context& context) {
    context.report("zones", 4, kPhases, 0);
    visit_samples(volume, [&]<class T>(std::span<const T> samples) {
        const GridView<T> grid{samples.data(), volume.info->extent};
        analysis.data().visit([&]<class Id>(IndexedArrays<Id>& held) {
            AnalysisArrays<Id>& arrays = held.arrays;
            if (!paths_fit(arrays.code.size())) {
                release(arrays.zone);
                arrays.element_voxels = voxels_by_tiles<T, Id>(grid, arrays.value, arrays.code, context);
                return;
            }
            if (arrays.zone.empty()) arrays.zone = basins_of_maxima<Id>(grid.extent, links_of_grid(grid, context), context);
            arrays.element_voxels = voxels_by_paths<T, Id>(grid, arrays.value, arrays.code, arrays.contours, arrays.zone, context);
        });
    });
    context.report("zones", 4, kPhases, 1);
}

bool add_zones(Analysis& analysis, const VolumeView& volume, const Context& context) {
    return visit_samples(volume, [&]<class T>(std::span<const T> samples) {
        const GridView<T> grid{samples.data(), volume.info->extent};
        return analysis.data().visit([&]<class Id>(IndexedArrays<Id>& held) {
            BigVector<Id>& basin = held.arrays.zone;
            if (basin.empty()) basin = basins_of_maxima<Id>(grid.extent, links_of_grid(grid, context), context);
            if (!fit(held.arrays, grid.extent)) return false;
            make_zones(grid, held.arrays, context);
            return true;
        });
    });
}

void complete(Analysis& analysis, const VolumeView& volume, const Context& context) {
    analysis.data().visit([&](auto& held) { ISOATLAS_CHECK(restore_trees(held.arrays, volume.info->extent.rank, context)); });
    ISOATLAS_CHECK(add_zones(analysis, volume, context));
}

Analysis analyse(const Volume& volume, const AnalysisOptions& options, const Context& context) {
    ISOATLAS_CHECK(static_cast<std::int64_t>(volume.bytes.size() / size_of(volume.info.type)) == volume.info.extent.voxels());
    Analysis analysis =
        analyse_with(volume, options, context, [&]<class T, class Id>(const GridView<T>& grid, GridScan scan, AnalysisArrays<Id>& arrays) {
            make_trees(critical_set(grid, std::move(scan), arrays, context), arrays, context);
            if (options.zones) {
                context.report("zones", 4, kPhases, 0);
                make_zones(grid, arrays, context);
                context.report("zones", 4, kPhases, 1);
            } else {
                release(arrays.zone);
            }
        });
    trim_memory_pool();
    return analysis;
}

}  // namespace isoatlas
