#include "critical/grid_scan.h"

#include <algorithm>
#include <utility>

#include "base/memory_limit.h"
#include "base/parallel.h"
#include "base/sample_types.h"
#include "critical/links.h"
#include "field/slab_work.h"

namespace isoatlas {
namespace {

std::int64_t slab_count(const Extent& extent, std::int64_t height) { return (extent.size[2] + height - 1) / height; }

}  // namespace

std::int64_t slab_height(const Extent& extent, const Context& context) {
    if (context.slab_slices > 0) return std::min(context.slab_slices, extent.size[2]);
    const std::int64_t threads = thread_count(context.threads), min = std::min<std::int64_t>(8, extent.size[2]);
    const std::int64_t shared = std::max(min, (extent.size[2] + 4 * threads - 1) / (4 * threads));
    if (!memory_is_limited()) return shared;
    constexpr std::int64_t kShare = 16, kBytes = 8;  // a voxel: of what is done to a slab
    return std::clamp<std::int64_t>(memory_limit() / (kShare * kBytes * threads * extent.slice()), std::min<std::int64_t>(2, min), shared);
}

template <class T>
GridScan scan_grid(const GridView<T>& grid, double tunnel_height, const Context& context) {
    const Extent& extent = grid.extent;
    GridScan scan;
    scan.height = slab_height(extent, context);
    scan.links.resize(static_cast<std::size_t>(extent.voxels()));
    std::vector<SlabScan> slabs(static_cast<std::size_t>(slab_count(extent, scan.height)));
    for_each_slab_of(scan.height, context, kAnalysisPhases["classify"], extent.size[2], [&](const Slab& slab) {
        const std::int64_t first = slab.z_begin * extent.slice(), count = (slab.z_end - slab.z_begin) * extent.slice();
        slabs[slab.z_begin / scan.height] = scan_slab(grid, slab, std::span<std::uint8_t>(scan.links).subspan(first, count), tunnel_height);
    });
    for (SlabScan& slab : slabs) {
        scan.first_maximum.push_back(std::exchange(scan.maxima, scan.maxima + slab.maxima));
        scan.first_minimum.push_back(std::exchange(scan.minima, scan.minima + slab.minima));
        for (BigVector<KeyedElement>& chunk : slab.chunks) {
            scan.elements += static_cast<std::int64_t>(chunk.size());
            scan.chunks.push_back(std::move(chunk));
        }
    }
    return scan;
}

template <class T>
BigVector<std::uint8_t> links_of_grid(const GridView<T>& grid, const Context& context) {
    const std::int64_t slice = grid.extent.slice();
    BigVector<std::uint8_t> links(static_cast<std::size_t>(grid.extent.voxels()));
    for_each_block(context.threads, grid.extent.size[2],
                   [&](std::int64_t z) { links_of_slice(grid, z, std::span<std::uint8_t>(links).subspan(z * slice, slice)); });
    return links;
}

#define ISOATLAS_SCAN(T)                                                     \
    template GridScan scan_grid(const GridView<T>&, double, const Context&); \
    template BigVector<std::uint8_t> links_of_grid(const GridView<T>&, const Context&);
ISOATLAS_FOR_SAMPLE_TYPES(ISOATLAS_SCAN)
#undef ISOATLAS_SCAN

}  // namespace isoatlas
