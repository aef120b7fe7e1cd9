#include "critical/grid_domain.h"

#include <algorithm>
#include <utility>

#include "base/bit_ranks.h"
#include "base/cancel.h"
#include "base/memory_limit.h"
#include "base/parallel.h"
#include "base/parallel_sort.h"
#include "base/sample_types.h"
#include "critical/elements_with_extrema.h"
#include "field/slab_work.h"

namespace isoatlas {
namespace {

/// Sorts the elements and takes them apart into arrays.
template <class Id>
CriticalSet<Id> sort_elements(ChunksWithExtrema<Id> chunks, const Above& above, int threads) {
    using Element = ElementWithExtrema<Id>;
    CriticalSet<Id> set;
    const auto allocate = [&](std::size_t n) {
        set.value.resize(n);
        set.code.resize(n);
        for (BigVector<Id>* field : {&set.up_a, &set.up_b, &set.low_a, &set.low_b}) field->resize(n);
    };
    const auto put = [&](std::size_t i, std::span<const Element> elements) {
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

template <class T, class IdType>
void GridDomain<T, IdType>::for_parts(const Context& context, const Phase& phase,
                                      const std::function<void(std::size_t, std::size_t)>& work) const {
    const auto slice = static_cast<std::size_t>(grid_.extent.slice());
    for_each_slab_of(slab_height(grid_.extent, context), context, phase, grid_.extent.size[2],
                     [&](const Slab& slab) { work(slab.z_begin * slice, (slab.z_end - slab.z_begin) * slice); });
}

template <class T, class IdType>
Criticals<IdType> GridDomain<T, IdType>::critical(bool keep_basins, const Context& context) {
    const Extent& extent = grid_.extent;
    Criticals<Id> result;
    stop_if_cancelled(context);
    report(context, kAnalysisPhases["basins"], 0);
    ChunksWithExtrema<Id> elements =
        elements_with_extrema<Id>(extent, scan_, {}, {}, keep_basins ? &result.basin : nullptr, context.threads);
    stop_if_cancelled(context);
    report(context, kAnalysisPhases["sort"], 0);
    result.set = sort_elements<Id>(std::move(elements), above_, context.threads);
    result.set.maxima = scan_.maxima, result.set.minima = scan_.minima, result.set.rank = extent.rank;
    return result;
}

template BigVector<std::uint32_t> elements_of_maxima(std::span<const std::uint64_t>, const Extent&);
template BigVector<std::uint64_t> elements_of_maxima(std::span<const std::uint64_t>, const Extent&);
#define ISOATLAS_GRID(T)                         \
    template class GridDomain<T, std::uint32_t>; \
    template class GridDomain<T, std::uint64_t>;
ISOATLAS_FOR_SAMPLE_TYPES(ISOATLAS_GRID)
#undef ISOATLAS_GRID
static_assert(Domain<GridDomain<float, std::uint32_t>>);

}  // namespace isoatlas
