#include <utility>

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

template <class T, class Number>
ByElement<Number, Number> voxels_by_paths(const GridView<T>& grid, ByElementView<Number, double> value,
                                          ByElementView<Number, std::uint64_t> code, const ContourTree<Number>& contours,
                                          std::span<Number> basin_to_element, const Context& context) {
    using Paths = HeavyPathDecomposition<Number, ComparisonValue<T>>;
    using Tree = DescendingTree<Number>;
    const std::size_t n = value.size();
    const PinInMemory keep;
    MergeTree<Number> join = join_tree_of(contours);
    ElementsOfMaxima<Number> maxima = elements_of_maxima<Number>(code, grid.extent);
    const MergeTreeView<Number> of_elements(std::span(std::as_const(join).items()).first(n));
    const Paths paths(Tree::of_elements(of_elements, value), maxima, context.threads);
    release(join.items());
    release(maxima.items());
    ByElement<Number, Number> voxels(filled(n, Number{0}));
    const std::int64_t slice = grid.extent.slice();
    for_each_slab_of(slab_height(grid.extent, context), context, kAnalysisPhases["zones"], grid.extent.size[2], [&](const Slab& slab) {
        const std::size_t first = slab.z_begin * slice, count = (slab.z_end - slab.z_begin) * slice;
        label_zones<T, Number>({grid.samples + first, count}, paths, basin_to_element.subspan(first, count), voxels.items());
    });
    return voxels;
}

// NOLINTBEGIN(bugprone-macro-parentheses): T, Number are types
#define ISOATLAS_BY_PATHS_OF(T, Number)                                                                                  \
    template ByElement<Number, Number> voxels_by_paths(const GridView<T>&, ByElementView<Number, double>,                \
                                                       ByElementView<Number, std::uint64_t>, const ContourTree<Number>&, \
                                                       std::span<Number>, const Context&);
#define ISOATLAS_BY_PATHS(T)               \
    ISOATLAS_BY_PATHS_OF(T, std::uint32_t) \
    ISOATLAS_BY_PATHS_OF(T, std::uint64_t)
ISOATLAS_FOR_SAMPLE_TYPES(ISOATLAS_BY_PATHS)
#undef ISOATLAS_BY_PATHS
#undef ISOATLAS_BY_PATHS_OF
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace isoatlas
