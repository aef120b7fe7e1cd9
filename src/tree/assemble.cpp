#include "tree/assemble.h"

#include <atomic>
#include <utility>

#include "base/check.h"
#include "base/memory_limit.h"
#include "base/parallel.h"
#include "base/part_streams.h"
#include "field/slab_work.h"
#include "tree/arcs_by_runs.h"
#include "tree/merge_tree.h"
#include "tree/reduce.h"

namespace isoatlas {
namespace {

/// The survivors of all parts, in the order of ranks.
template <class Id>
struct Survivors {
    RepresentedSet<Id> set;
    BigVector<Id> rank;
};

/// Reduces all parts. Returns per element where its arc leads, within its part.
template <class Id>
BigVector<Id> reduce_parts(PartitionedSet<Id>& set, const Context& context) {
    const OpenExtrema open = open_extrema(set, context.threads);
    BigVector<Id> arc(set.size());
    for_each_slab_of(1, context, kAnalysisPhases["trees"], static_cast<std::int64_t>(set.parts()), [&](const Slab& slab) {
        const auto part = static_cast<std::size_t>(slab.z_begin);
        change_part(set.of(part, set.elements), [&](std::span<PartitionedElement<Id>> elements) {
            change_part(set.of(part, arc), [&](std::span<Id> arcs) { reduce_part<Id>(set, part, open, elements, arcs); });
        });
    });
    return arc;
}

/// The representatives in use, those of leaves that survive, and how many elements survive.
struct NamesInUse {
    OpenExtrema names;
    std::atomic<std::size_t> survivors = 0;

    template <class Id>
    NamesInUse(const PartitionedSet<Id>& set, int threads) : names{BitRanks(set.first_maximum.back()), BitRanks(set.first_minimum.back())} {
        names.minima.add(0);
        for_each_block(threads, static_cast<std::int64_t>(set.parts()), [&](std::int64_t part) {
            std::size_t count = 0;
            for (const auto& [representatives, branches] : set.of(part, set.elements)) {
                if (branches == kRemoved) continue;
                ++count;
                if (branches_above(branches) == 0) names.maxima.add(representatives.above[0]);
                if (branches_below(branches) == 0) names.minima.add(representatives.below[0]);
            }
            survivors += count;
        });
    }
};

/// rank: becomes that of every element.
template <class Id>
Survivors<Id> gather_survivors(const PartitionedSet<Id>& set, std::span<const std::uint16_t> part_of, std::span<Id> rank, int threads) {
    Survivors<Id> survivors;
    NamesInUse in_use(set, threads);
    auto& [maxima, minima] = in_use.names;
    survivors.set.maxima = maxima.count();
    survivors.set.minima = minima.count() - 1;
    survivors.set.branches.reserve(in_use.survivors);
    survivors.set.representatives.reserve(in_use.survivors);
    survivors.rank.reserve(in_use.survivors + 1);
    PartReaders<PartitionedElement<Id>> elements(set.elements, set.first);
    PartWriters<Id> ranks(rank, set.first);
    BudgetPoll memory;
    for (std::size_t r = 0; r < part_of.size(); ++r) {
        memory.step();
        ranks.put(part_of[r], static_cast<Id>(r));
        auto [representatives, branches] = elements.next(part_of[r]);
        if (branches == kRemoved) continue;
        for (Id& name : representatives.above) name = static_cast<Id>(maxima.rank(name));
        for (Id& name : representatives.below) name = static_cast<Id>(minima.rank(name));
        survivors.set.branches.push_back(branches);
        survivors.set.representatives.push_back(representatives);
        survivors.rank.push_back(static_cast<Id>(r));
    }
    ranks.finish();
    return survivors;
}

/// Where the arcs of survivors lead, as ranks. outside: its rank.
template <class Id>
BigVector<Id> arcs_of_survivors(Survivors<Id> survivors, Id outside, int threads) {
    BigVector<Id> join, split;
    run_both(threads, [&] { join = join_tree(survivors.set); }, [&] { split = split_tree(survivors.set); });
    release(survivors.set.representatives);
    BigVector<Id> arcs = arcs_by_runs<Id>(survivors.set.branches, std::move(join), std::move(split), threads);
    survivors.rank.push_back(outside);
    BudgetPoll memory;
    for (Id& other : arcs) {
        memory.step();
        other = survivors.rank[other];
    }
    return arcs;
}

}  // namespace

template <class Id>
BigVector<Id> contour_arcs(PartitionedSet<Id> set, std::span<const std::uint16_t> part_of, const Context& context) {
    const std::size_t n = set.size();
    const int threads = context.threads;
    BigVector<Id> arc = reduce_parts(set, context), rank(n);
    Survivors<Id> survivors = gather_survivors<Id>(set, part_of, rank, threads);
    // Places within parts become ranks; survivors lead to themselves.
    for_each_block(threads, static_cast<std::int64_t>(set.parts()), [&](std::int64_t part) {
        const std::span<const Id> ranks = set.of(part, rank);
        const std::span<const PartitionedElement<Id>> elements = set.of(part, set.elements);
        const std::span<Id> to = set.of(part, arc);
        for (std::size_t x = 0; x < to.size(); ++x) to[x] = ranks[elements[x].branches == kRemoved ? to[x] : x];
    });
    release(rank);
    release(set.elements);
    const BigVector<Id> of_survivors = arcs_of_survivors(std::move(survivors), static_cast<Id>(n), threads);
    BigVector<Id> other(n + 1);
    PartReaders<Id> arcs(arc, set.first);
    BudgetPoll memory;
    std::size_t survivor = 0;
    for (std::size_t r = 0; r < n; ++r) {
        memory.step();
        const Id to = arcs.next(part_of[r]);
        other[r] = to == static_cast<Id>(r) ? of_survivors[survivor++] : to;
    }
    other[n] = static_cast<Id>(n);
    ISOATLAS_CHECK(survivor + 1 == of_survivors.size());
    return other;
}

template BigVector<std::uint32_t> contour_arcs(PartitionedSet<std::uint32_t>, std::span<const std::uint16_t>, const Context&);
template BigVector<std::uint64_t> contour_arcs(PartitionedSet<std::uint64_t>, std::span<const std::uint16_t>, const Context&);

}  // namespace isoatlas
