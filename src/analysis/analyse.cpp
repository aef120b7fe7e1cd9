// The engine for regular grids.
#include <memory>
#include <utility>

#include "analysis/analyse_domain.h"
#include "analysis/grid_scanner.h"
#include "base/check.h"
#include "base/memory_limit.h"
#include "field/volume_view.h"
#include "isoatlas/environment.h"

namespace isoatlas {

Analysis analyse(const Volume& volume, const AnalysisOptions& options, const Context& context) {
    const EnvironmentScope scope(context);
    ISOATLAS_CHECK(static_cast<std::int64_t>(volume.bytes.size() / size_of(volume.info.type)) == volume.info.extent.voxels());
    auto data = std::make_unique<Analysis::Data>();
    data->extent = volume.info.extent;
    data->interpolant = options.interpolant;
    data->tunnel_height = options.tunnel_height;
    with_scan(volume, options, context, [&]<class T, class Number>(const GridView<T>& grid, GridScan scan, Number) {
        auto held = std::make_unique<IndexedArrays<Number>>();
        GridDomain<T, Number> domain(grid, std::move(scan));
        analyse_domain(domain, options.zones, held->arrays, context);
        data->arrays = std::move(held);
    });
    trim_memory_pool();
    return Analysis(std::move(data));
}

}  // namespace isoatlas
