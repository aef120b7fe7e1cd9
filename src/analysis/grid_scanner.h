// The first pass over a grid, and which width of ids it needs.
#pragma once

#include <utility>

#include "critical/bodies.h"
#include "critical/grid_domain.h"
#include "field/volume_view.h"
#include "isoatlas/analysis.h"

namespace isoatlas {

/// 32 bits for voxels, critical elements and sums of Euler numbers while they are certain to fit.
inline bool fits_32_bits(const Extent& extent, const GridScan& scan) {
    return extent.voxels() < std::int64_t{1} << 31 && scan.elements < std::int64_t{1} << 30;
}

/// Calls use(grid, scan, Number{}) with the width of ids that fits. Cost: that of scan_grid().
template <class Use>
void with_scan(const VolumeView& volume, const AnalysisOptions& options, const Context& context, const Use& use) {
    visit_samples(volume, [&]<class T>(std::span<const T> samples) {
        const GridView<T> grid{samples.data(), volume.info->extent};
        report(context, kAnalysisPhases["classify"], 0);
        GridScan scan = scan_grid(grid, tunnel_height_of(options.interpolant, options.tunnel_height), context);
        if (fits_32_bits(grid.extent, scan)) {
            use(grid, std::move(scan), std::uint32_t{});
        } else {
            use(grid, std::move(scan), std::uint64_t{});
        }
    });
}

}  // namespace isoatlas
