#include "tree/assemble.h"

#include <atomic>
#include <utility>

#include "base/check.h"
#include "base/parallel.h"
#include "base/part_streams.h"
#include "base/streamed.h"
#include "field/slab_work.h"
#include "tree/arcs_by_runs.h"
#include "tree/merge_tree.h"
#include "tree/reduce.h"

namespace isoatlas {
namespace {

/// The survivors of all parts, in the order of ranks.
template <class Number>
struct Survivors {
    RepresentedSet<Number> set;
    ByElement<Number, ElementIdOf<Number>> rank;  ///< per survivor, and of the outside: as an element of the whole
};

/// Reduces all parts. Returns per element where its arc leads, within its part.
template <class Number>
BigVector<ElementIdOf<Number>> reduce_parts(PartitionedSet<Number>& set, const Context& context) {
    using Element = ElementIdOf<Number>;
    const OpenExtrema open = open_extrema(set, context.threads);
    BigVector<Element> arc(set.size());
    for_each_slab_of(1, context, kAnalysisPhases["trees"], static_cast<std::int64_t>(set.parts()), [&](const Slab& slab) {
        const auto part = static_cast<std::size_t>(slab.z_begin);
        change_part(set.of(part, set.elements), [&](std::span<PartitionedElement<Number>> elements) {
            change_part(set.of(part, arc), [&](std::span<Element> arcs) { reduce_part<Number>(set, part, open, elements, arcs); });
        });
    });
    return arc;
}

/// The representatives in use, those of leaves that survive, and how many elements survive.
struct NamesInUse {
    OpenExtrema names;
    std::atomic<std::size_t> survivors = 0;

    template <class Number>
    NamesInUse(const PartitionedSet<Number>& set, int threads)
        : names{BitRanks(set.first_maximum.back().index()), BitRanks(set.first_minimum.back().index())} {
        names.minima.add(0);
        for_each_block(threads, static_cast<std::int64_t>(set.parts()), [&](std::int64_t part) {
            std::size_t count = 0;
            for (const auto& [representatives, branches] : set.of(part, set.elements)) {
                if (branches == kRemoved) continue;
                ++count;
                if (branches_above(branches) == 0) names.maxima.add(representatives.above[0].index());
                if (branches_below(branches) == 0) names.minima.add(representatives.below[0].index());
            }
            survivors += count;
        });
    }
};

/// rank: becomes that of every element.
template <class Number>
Survivors<Number> gather_survivors(const PartitionedSet<Number>& set, std::span<const std::uint16_t> part_of,
                                   std::span<ElementIdOf<Number>> rank, int threads) {
    using Element = ElementIdOf<Number>;
    Survivors<Number> survivors;
    NamesInUse in_use(set, threads);
    auto& [maxima, minima] = in_use.names;
    survivors.set.maxima = maxima.count();
    survivors.set.minima = minima.count() - 1;
    survivors.set.branches.items().reserve(in_use.survivors);
    survivors.set.representatives.items().reserve(in_use.survivors);
    survivors.rank.items().reserve(in_use.survivors + 1);
    PartReaders<PartitionedElement<Number>> elements(set.elements, set.first);
    PartWriters<Element> ranks(rank, set.first);
    for (const Element r : streamed<Element>(part_of.size(), in_order(8))) {
        const std::uint16_t part = part_of[r.index()];
        ranks.put(part, r);
        auto [representatives, branches] = elements.next(part);
        if (branches == kRemoved) continue;
        for (MaximumIdOf<Number>& name : representatives.above) name = MaximumIdOf<Number>(maxima.rank(name.index()));
        for (MinimumIdOf<Number>& name : representatives.below) name = MinimumIdOf<Number>(minima.rank(name.index()));
        survivors.set.branches.push_back(branches);
        survivors.set.representatives.push_back(representatives);
        survivors.rank.push_back(r);
    }
    ranks.finish();
    return survivors;
}

/// Where the arcs of survivors lead, as ranks. outside: its rank.
template <class Number>
ByElement<Number, ElementIdOf<Number>> arcs_of_survivors(Survivors<Number> survivors, ElementIdOf<Number> outside, int threads) {
    using Element = ElementIdOf<Number>;
    MergeTree<Number> join, split;
    run_both(threads, [&] { join = join_tree(survivors.set); }, [&] { split = split_tree(survivors.set); });
    release(survivors.set.representatives.items());
    ByElement<Number, Element> arcs = arcs_by_runs<Number>(survivors.set.branches, std::move(join), std::move(split), threads);
    survivors.rank.push_back(outside);
    for (const Element survivor : streamed<Element>(arcs.size(), in_order(8))) arcs[survivor] = survivors.rank[arcs[survivor]];
    return arcs;
}

}  // namespace

template <class Number>
ByElement<Number, ElementIdOf<Number>> contour_arcs(PartitionedSet<Number> set, std::span<const std::uint16_t> part_of,
                                                    const Context& context) {
    using Element = ElementIdOf<Number>;
    const std::size_t n = set.size();
    const int threads = context.threads;
    BigVector<Element> arc = reduce_parts(set, context), rank(n);
    Survivors<Number> survivors = gather_survivors<Number>(set, part_of, rank, threads);
    // Places within parts become ranks; survivors lead to themselves.
    for_each_block(threads, static_cast<std::int64_t>(set.parts()), [&](std::int64_t part) {
        const std::span<const Element> ranks = set.of(part, rank);
        const std::span<const PartitionedElement<Number>> elements = set.of(part, set.elements);
        const std::span<Element> to = set.of(part, arc);
        for (std::size_t x = 0; x < to.size(); ++x) to[x] = ranks[elements[x].branches == kRemoved ? to[x].index() : x];
    });
    release(rank);
    release(set.elements);
    const ByElement<Number, Element> of_survivors = arcs_of_survivors(std::move(survivors), Element(n), threads);
    ByElement<Number, Element> other(n + 1);
    PartReaders<Element> arcs(arc, set.first);
    Element survivor(0);
    for (const Element r : streamed<Element>(n, in_order(8))) {
        const Element to = arcs.next(part_of[r.index()]);
        other[r] = to;
        if (to != r) continue;
        other[r] = of_survivors[survivor];
        ++survivor;
    }
    other[Element(n)] = Element(n);
    ISOATLAS_CHECK(survivor.index() + 1 == of_survivors.size());
    return other;
}

#define ISOATLAS_ASSEMBLE(Number) \
    template MergeTree<Number> contour_arcs(PartitionedSet<Number>, std::span<const std::uint16_t>, const Context&);
ISOATLAS_ASSEMBLE(std::uint32_t)
ISOATLAS_ASSEMBLE(std::uint64_t)
#undef ISOATLAS_ASSEMBLE

}  // namespace isoatlas
