// The engine from samples to zones: the flow of the whole library on one page.
#include "zones/analyse.h"

#include <utility>

#include "base/check.h"
#include "base/memory_limit.h"
#include "base/parallel.h"
#include "critical/bodies.h"
#include "critical/grid_domain.h"
#include "critical/parted_domain.h"
#include "tree/assemble.h"
#include "zones/analysis_data.h"
#include "zones/label.h"
#include "zones/paths.h"
#include "zones/trees.h"

namespace isoatlas {
namespace {

constexpr int kPhases = 5;

/// 32 bits for voxels, critical elements and sums of Euler numbers while they are certain to fit.
bool fits_32_bits(const Extent& extent, const GridScan& scan) {
    return extent.voxels() < std::int64_t{1} << 31 && scan.elements < std::int64_t{1} << 30;
}

/// The basins stay in arrays.zone for add_zones(), unless memory is short: then they are made anew.
template <class T, class Id>
std::unique_ptr<IndexedArrays<Id>> find_trees(const GridView<T>& grid, GridScan scan, const Context& context) {
    auto result = std::make_unique<IndexedArrays<Id>>();
    Criticals<Id> criticals = GridDomain<T, Id>(grid, std::move(scan)).critical(!memory_is_limited(), context);
    result->arrays.zone = std::move(criticals.basin);
    context.report("trees", 3, kPhases, 0);
    make_trees(std::move(criticals.set), result->arrays, context.threads);
    return result;
}

/// The same trees when memory is short: nothing is accessed at random but a tile at a time.
template <class Id>
std::unique_ptr<IndexedArrays<Id>> find_trees_by_tiles(const Extent& extent, GridScan scan, const Context& context) {
    auto result = std::make_unique<IndexedArrays<Id>>();
    AnalysisArrays<Id>& arrays = result->arrays;
    PartedCriticals<Id> criticals = parted_criticals<Id>(extent, std::move(scan), tiling_for(extent, context), context);
    context.report("trees", 3, kPhases, 0);
    arrays.value = std::move(criticals.value);
    arrays.code = std::move(criticals.code);
    arrays.contours.other = contour_arcs<Id>(std::move(criticals.set), criticals.part_of, context.threads);
    context.report("restore", 3, kPhases, 0.5);
    ISOATLAS_CHECK(restore_trees(arrays, extent.rank, context.threads));
    return result;
}

/// Per maximum: its critical element.
template <class Id>
BigVector<Id> elements_of_maxima(const AnalysisArrays<Id>& arrays, std::span<const Id> basin) {
    std::size_t maxima = 0;
    for (const std::uint64_t code : arrays.code) maxima += ElementCode{code}.h0() == 0;
    BigVector<Id> element(maxima);
    for (std::size_t i = 0; i < arrays.code.size(); ++i) {
        const ElementCode code{arrays.code[i]};
        if (code.h0() == 0) element[Basins<Id>::number(basin[code.index()])] = static_cast<Id>(i);
    }
    return element;
}

/// The basins in arrays.zone become zones in place.
template <class T, class Id>
void make_zones(const GridView<T>& grid, AnalysisArrays<Id>& arrays, const Context& context) {
    BigVector<Id> maxima = elements_of_maxima<Id>(arrays, arrays.zone);
    const HeavyPaths<Id, ComparisonValue<T>> paths(arrays.tree, arrays.value, maxima, context.threads);
    release(maxima);
    arrays.voxels.assign(arrays.tree.size(), Id{0});
    const std::int64_t height = slab_height(grid.extent, context), slabs = (grid.extent.size[2] + height - 1) / height;
    for_each_block(context.threads, slabs, [&](std::int64_t i) {
        const Slab slab = slab_at(i, height, grid.extent.size[2]);
        const std::size_t first = slab.z_begin * grid.extent.slice(), count = (slab.z_end - slab.z_begin) * grid.extent.slice();
        label_zones<T, Id>({grid.samples + first, count}, paths, std::span<Id>(arrays.zone).subspan(first, count), arrays.voxels);
    });
}

}  // namespace

Analysis analyse_trees(const VolumeView& volume, const AnalysisOptions& options, const Context& context) {
    auto data = std::make_unique<Analysis::Data>();
    data->extent = volume.info->extent;
    data->interpolant = options.interpolant;
    data->tunnel_height = options.tunnel_height;
    visit_samples(volume, [&]<class T>(std::span<const T> samples) {
        const GridView<T> grid{samples.data(), data->extent};
        context.report("classify", 0, kPhases, 0);
        GridScan scan = scan_grid(grid, tunnel_height_of(options.interpolant, options.tunnel_height), context);
        const bool is_narrow = fits_32_bits(data->extent, scan);
        if (memory_is_limited() && is_narrow) {
            data->arrays = find_trees_by_tiles<std::uint32_t>(data->extent, std::move(scan), context);
        } else if (memory_is_limited()) {
            data->arrays = find_trees_by_tiles<std::uint64_t>(data->extent, std::move(scan), context);
        } else if (is_narrow) {
            data->arrays = find_trees<T, std::uint32_t>(grid, std::move(scan), context);
        } else {
            data->arrays = find_trees<T, std::uint64_t>(grid, std::move(scan), context);
        }
    });
    return Analysis(std::move(data));
}

void add_zones(Analysis& analysis, const VolumeView& volume, bool of_voxels, const Context& context) {
    context.report("zones", 4, kPhases, 0);
    visit_samples(volume, [&]<class T>(std::span<const T> samples) {
        const GridView<T> grid{samples.data(), volume.info->extent};
        analysis.data().visit([&]<class Id>(IndexedArrays<Id>& held) {
            if (held.arrays.zone.empty()) held.arrays.zone = basins_of_maxima<T, Id>(grid, context);
            make_zones(grid, held.arrays, context);
            if (!of_voxels) release(held.arrays.zone);
        });
    });
    context.report("zones", 4, kPhases, 1);
}

Analysis analyse(const Volume& volume, const AnalysisOptions& options, const Context& context) {
    ISOATLAS_CHECK(static_cast<std::int64_t>(volume.bytes.size() / size_of(volume.info.type)) == volume.info.extent.voxels());
    Analysis analysis = analyse_trees(volume, options, context);
    if (options.zones) {
        add_zones(analysis, volume, true, context);
    } else {
        analysis.data().visit([](auto& held) { release(held.arrays.zone); });
    }
    return_big_memory();
    return analysis;
}

}  // namespace isoatlas
