#include "critical/grid_domain.h"

#include <algorithm>
#include <utility>

#include "base/bit_ranks.h"
#include "base/cancel.h"
#include "base/parallel.h"
#include "base/parallel_sort.h"
#include "base/sample_types.h"
#include "base/streamed.h"
#include "critical/elements_with_extrema.h"
#include "field/slab_work.h"

namespace isoatlas {
namespace {

/// Sorts the elements and takes them apart into arrays.
template <class Number>
CriticalSet<Number> sort_elements(ChunksWithExtrema<Number> chunks, const Above& above, int threads) {
    using Element = ElementWithExtrema<Number>;
    CriticalSet<Number> set;
    const auto allocate = [&](std::size_t n) {
        set.value.items().resize(n);
        set.code.items().resize(n);
        for (auto* field : {&set.up_a, &set.up_b}) field->items().resize(n);
        for (auto* field : {&set.low_a, &set.low_b}) field->items().resize(n);
    };
    const auto put = [&](std::size_t first, std::span<const Element> elements) {
        ElementIdOf<Number> i(first);
        for (const Element& element : elements) {
            set.value[i] = element.key.value, set.code[i] = element.key.code.bits;
            set.up_a[i] = element.representatives.above[0], set.up_b[i] = element.representatives.above[1];
            set.low_a[i] = element.representatives.below[0], set.low_b[i] = element.representatives.below[1];
            ++i;
        }
    };
    sort_chunks(
        threads, std::move(chunks), [](const Element& element) { return -element.key.value; },
        [&](const Element& p, const Element& q) { return above(p.key, q.key); }, allocate, put);
    return set;
}

}  // namespace

template <class Number>
ElementsOfMaxima<Number> elements_of_maxima(ByElementView<Number, std::uint64_t> code, const Extent& extent) {
    using Element = ElementIdOf<Number>;
    const auto is_maximum = [](ElementCode element) { return element.h0() == 0; };
    BitRanks maxima(static_cast<std::size_t>(extent.voxels()));
    for (const Element i : streamed<Element>(code.size(), at_random_one_in(4))) {
        if (const ElementCode element{code[i]}; is_maximum(element)) maxima.add(static_cast<std::size_t>(element.index()));
    }
    ElementsOfMaxima<Number> elements(maxima.count());
    for (const Element i : streamed<Element>(code.size(), at_random_one_in(2))) {
        if (const ElementCode element{code[i]}; is_maximum(element)) elements[MaximumIdOf<Number>(maxima.rank(element.index()))] = i;
    }
    return elements;
}

template <class T, class NumberType>
void GridDomain<T, NumberType>::for_parts(const Context& context, const Phase& phase,
                                          const std::function<void(std::size_t, std::size_t)>& work) const {
    const auto slice = static_cast<std::size_t>(grid_.extent.slice());
    for_each_slab_of(slab_height(grid_.extent, context), context, phase, grid_.extent.size[2],
                     [&](const Slab& slab) { work(slab.z_begin * slice, (slab.z_end - slab.z_begin) * slice); });
}

template <class T, class NumberType>
Criticals<NumberType> GridDomain<T, NumberType>::critical(bool keep_basins, const Context& context) {
    const Extent& extent = grid_.extent;
    Criticals<Number> result;
    stop_if_cancelled(context);
    report(context, kAnalysisPhases["basins"], 0);
    ChunksWithExtrema<Number> elements =
        elements_with_extrema<Number>(extent, scan_, {}, {}, keep_basins ? &result.basin.items() : nullptr, context.threads);
    stop_if_cancelled(context);
    report(context, kAnalysisPhases["sort"], 0);
    result.set = sort_elements<Number>(std::move(elements), above_, context.threads);
    result.set.maxima = scan_.maxima, result.set.minima = scan_.minima, result.set.rank = extent.rank;
    return result;
}

template ElementsOfMaxima<std::uint32_t> elements_of_maxima(ByElementView<std::uint32_t, std::uint64_t>, const Extent&);
template ElementsOfMaxima<std::uint64_t> elements_of_maxima(ByElementView<std::uint64_t, std::uint64_t>, const Extent&);
#define ISOATLAS_GRID(T)                         \
    template class GridDomain<T, std::uint32_t>; \
    template class GridDomain<T, std::uint64_t>;
ISOATLAS_FOR_SAMPLE_TYPES(ISOATLAS_GRID)
#undef ISOATLAS_GRID
static_assert(Domain<GridDomain<float, std::uint32_t>>);

}  // namespace isoatlas
