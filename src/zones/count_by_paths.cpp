#include "base/memory_limit.h"
#include "base/paced_fill.h"
#include "base/sample_types.h"
#include "critical/grid_domain.h"
#include "field/order.h"
#include "field/slab_work.h"
#include "zones/count_voxels.h"
#include "zones/label.h"

namespace isoatlas {

bool paths_fit(std::size_t elements) {
    constexpr std::int64_t kBytes = 24;  // an element
    return static_cast<std::int64_t>(elements) <= memory_at_random() / kBytes;
}

template <class T, class Id>
BigVector<Id> voxels_by_paths(const GridView<T>& grid, std::span<const double> value, std::span<const std::uint64_t> code,
                              const ContourTree<Id>& contours, std::span<const Id> basin, const Context& context) {
    using Paths = HeavyPathDecomposition<Id, ComparisonValue<T>>;
    const std::size_t n = value.size();
    const PinInMemory keep;
    BigVector<Id> join = join_tree_of(contours), maxima = elements_of_maxima<Id>(code, grid.extent);
    const Paths paths({std::span<const Id>(join).first(n), value, {}, {}}, maxima, context.threads);
    release(join);
    release(maxima);
    BigVector<Id> voxels = filled<Id>(n, Id{0});
    const std::int64_t slice = grid.extent.slice();
    for_each_slab_of(slab_height(grid.extent, context), context, kAnalysisPhases["zones"], grid.extent.size[2], [&](const Slab& slab) {
        const std::size_t first = slab.z_begin * slice, count = (slab.z_end - slab.z_begin) * slice;
        count_zones<T, Id>({grid.samples + first, count}, paths, basin.subspan(first, count), voxels);
    });
    return voxels;
}

// NOLINTBEGIN(bugprone-macro-parentheses): T is a type
#define ISOATLAS_BY_PATHS(T)                                                                                                              \
    template BigVector<std::uint32_t> voxels_by_paths(const GridView<T>&, std::span<const double>, std::span<const std::uint64_t>,        \
                                                      const ContourTree<std::uint32_t>&, std::span<const std::uint32_t>, const Context&); \
    template BigVector<std::uint64_t> voxels_by_paths(const GridView<T>&, std::span<const double>, std::span<const std::uint64_t>,        \
                                                      const ContourTree<std::uint64_t>&, std::span<const std::uint64_t>, const Context&);
ISOATLAS_FOR_SAMPLE_TYPES(ISOATLAS_BY_PATHS)
#undef ISOATLAS_BY_PATHS
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace isoatlas
