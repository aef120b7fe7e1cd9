#include "tree/assemble.h"

#include <utility>

#include "base/check.h"
#include "base/parallel.h"
#include "tree/contour_tree.h"
#include "tree/merge_tree.h"
#include "tree/reduce.h"

namespace isoatlas {
namespace {

/// The survivors of all parts, in the order of ranks.
template <class Id>
struct Survivors {
    NamedSet<Id> set;
    BigVector<Id> rank;
};

/// Reduces all parts. Returns per element where its arc leads, within its part; survivors lead to themselves.
template <class Id>
BigVector<Id> reduce_parts(PartedSet<Id>& set, int threads) {
    const OpenExtrema open = open_extrema(set, threads);
    BigVector<Id> arc(set.size());
    for_each_block(threads, static_cast<std::int64_t>(set.parts()),
                   [&](std::int64_t part) { reduce_part<Id>(set, part, open, set.of(part, arc)); });
    return arc;
}

template <class Id>
bool survives(std::span<const Id> arc, std::size_t x) {
    return arc[x] == static_cast<Id>(x);
}

/// The names that are in use: those of leaves that survive.
template <class Id>
OpenExtrema names_in_use(const PartedSet<Id>& set, const BigVector<Id>& arc, int threads) {
    OpenExtrema names{BitRanks(set.first_maximum.back()), BitRanks(set.first_minimum.back())};
    names.minima.add(0);
    for_each_block(threads, static_cast<std::int64_t>(set.parts()), [&](std::int64_t part) {
        const std::span<const Id> arcs = set.of(part, arc);
        for (std::size_t x = 0; x < arcs.size(); ++x) {
            if (!survives(arcs, x)) continue;
            const std::size_t i = set.first[part] + x;
            if (branches_above(set.branches[i]) == 0) names.maxima.add(set.ends[i].above[0]);
            if (branches_below(set.branches[i]) == 0) names.minima.add(set.ends[i].below[0]);
        }
    });
    return names;
}

/// rank: becomes that of every element.
template <class Id>
Survivors<Id> gather_survivors(const PartedSet<Id>& set, const BigVector<Id>& arc, std::span<const std::uint16_t> part_of,
                               std::span<Id> rank, int threads) {
    Survivors<Id> survivors;
    OpenExtrema names = names_in_use(set, arc, threads);
    survivors.set.maxima = names.maxima.count();
    survivors.set.minima = names.minima.count() - 1;
    std::size_t count = 0;
    for (std::size_t part = 0; part < set.parts(); ++part) {
        const std::span<const Id> arcs = set.of(part, arc);
        for (std::size_t x = 0; x < arcs.size(); ++x) count += survives(arcs, x);
    }
    survivors.set.branches.reserve(count);
    survivors.set.ends.reserve(count);
    survivors.rank.reserve(count);
    std::vector<std::size_t> next = set.first;
    for (std::size_t r = 0; r < part_of.size(); ++r) {
        const std::size_t part = part_of[r], i = next[part]++;
        rank[i] = static_cast<Id>(r);
        if (arc[i] != static_cast<Id>(i - set.first[part])) continue;
        Ends<Id> ends = set.ends[i];
        for (Id& name : ends.above) name = static_cast<Id>(names.maxima.rank(name));
        for (Id& name : ends.below) name = static_cast<Id>(names.minima.rank(name));
        survivors.set.branches.push_back(set.branches[i]);
        survivors.set.ends.push_back(ends);
        survivors.rank.push_back(static_cast<Id>(r));
    }
    return survivors;
}

/// Where the arcs of survivors lead, as ranks. outside: its rank.
template <class Id>
BigVector<Id> arcs_of_survivors(Survivors<Id> survivors, Id outside, int threads) {
    BigVector<Id> join, split;
    run_both(threads, [&] { join = join_tree(survivors.set); }, [&] { split = split_tree(survivors.set); });
    survivors.set = {};
    ContourTree<Id> tree = contour_tree<Id>(join, std::move(split), {}, threads);
    survivors.rank.push_back(outside);
    for (Id& other : tree.other) other = survivors.rank[other];
    return std::move(tree.other);
}

}  // namespace

template <class Id>
BigVector<Id> contour_arcs(PartedSet<Id> set, std::span<const std::uint16_t> part_of, int threads) {
    const std::size_t n = set.size();
    BigVector<Id> arc = reduce_parts(set, threads);
    BigVector<Id> rank(n);
    Survivors<Id> survivors = gather_survivors<Id>(set, arc, part_of, rank, threads);
    release(set.branches);
    release(set.ends);
    const BigVector<Id> of_survivors = arcs_of_survivors(std::move(survivors), static_cast<Id>(n), threads);
    // Places within parts become ranks; survivors lead to themselves.
    for_each_block(threads, static_cast<std::int64_t>(set.parts()), [&](std::int64_t part) {
        const std::span<const Id> ranks = set.of(part, rank);
        for (Id& to : set.of(part, arc)) to = ranks[to];
    });
    release(rank);
    BigVector<Id> other(n + 1);
    std::vector<std::size_t> next = set.first;
    std::size_t survivor = 0;
    for (std::size_t r = 0; r < n; ++r) {
        const Id to = arc[next[part_of[r]]++];
        other[r] = to == static_cast<Id>(r) ? of_survivors[survivor++] : to;
    }
    other[n] = static_cast<Id>(n);
    ISOATLAS_CHECK(survivor + 1 == of_survivors.size());
    return other;
}

template BigVector<std::uint32_t> contour_arcs(PartedSet<std::uint32_t>, std::span<const std::uint16_t>, int);
template BigVector<std::uint64_t> contour_arcs(PartedSet<std::uint64_t>, std::span<const std::uint16_t>, int);

}  // namespace isoatlas
