#include "base/bit_ranks.h"
#include "base/memory_limit.h"
#include "base/paced_fill.h"
#include "base/sample_types.h"
#include "critical/grid_scan.h"
#include "field/order.h"
#include "field/slab_work.h"
#include "zones/count_voxels.h"
#include "zones/label.h"

namespace isoatlas {

bool paths_fit(std::size_t elements) {
    constexpr std::int64_t kBytes = 24;  // an element
    return static_cast<std::int64_t>(elements) <= memory_at_random() / kBytes;
}

template <class Id>
BigVector<Id> elements_of_maxima(std::span<const std::uint64_t> code, const Extent& extent) {
    const auto is_maximum = [](ElementCode element) { return element.h0() == 0; };
    BitRanks maxima(static_cast<std::size_t>(extent.voxels()));
    BudgetPoll memory;
    for (const std::uint64_t bits : code) {
        memory.step(BudgetPoll::kTouch / 4);
        if (const ElementCode element{bits}; is_maximum(element)) maxima.add(static_cast<std::size_t>(element.index()));
    }
    BigVector<Id> elements(maxima.count());
    for (std::size_t i = 0; i < code.size(); ++i) {
        memory.step(BudgetPoll::kTouch / 2);
        if (const ElementCode element{code[i]}; is_maximum(element)) elements[maxima.rank(element.index())] = static_cast<Id>(i);
    }
    return elements;
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
    for_each_slab_of(slab_height(grid.extent, context), context, {"zones", 4, 5}, grid.extent.size[2], [&](const Slab& slab) {
        const std::size_t first = slab.z_begin * slice, count = (slab.z_end - slab.z_begin) * slice;
        count_zones<T, Id>({grid.samples + first, count}, paths, basin.subspan(first, count), voxels);
    });
    return voxels;
}

template BigVector<std::uint32_t> elements_of_maxima(std::span<const std::uint64_t>, const Extent&);
template BigVector<std::uint64_t> elements_of_maxima(std::span<const std::uint64_t>, const Extent&);
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
