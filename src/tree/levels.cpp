#include "tree/levels.h"

#include <algorithm>
#include <utility>

#include "base/parallel.h"
#include "base/union_find.h"

namespace isoatlas {

template <class Id>
BigVector<Id> level_roots(const ContourTree<Id>& tree, std::span<const double> value) {
    const std::size_t n = value.size();
    UnionFind<Id> sets(n);
    for (std::size_t x = 0; x <= n; ++x) {
        if (tree.has_arc(x) && !has_length(tree, value, x)) sets.join(tree.upper(x), tree.lower(x));
    }
    return std::move(sets).roots();
}

template <class Id>
LevelFlow<Id> level_flow(const ContourTree<Id>& tree, std::span<const Id> level, std::span<const double> value, int threads) {
    using Side = typename LevelFlow<Id>::Side;
    const std::size_t n = value.size();
    const auto gather = [&](BigVector<Side>& side, auto&& end_of) {  // end_of(arc): the element at the end that counts
        side.assign(n, Side{0, 0});
        for (std::size_t x = 0; x <= n; ++x) {
            if (!tree.has_arc(x) || !has_length(tree, value, x)) continue;
            const std::size_t element = end_of(x);
            if (element == n) continue;  // the outside
            Side& at = side[level[element]];
            ++at.contours;
            at.genus += 1 - tree.half_chi[x];
        }
    };
    LevelFlow<Id> flow;
    run_both(threads, [&] { gather(flow.in, [&](std::size_t x) { return tree.lower(x); }); },
             [&] { gather(flow.out, [&](std::size_t x) { return tree.upper(x); }); });
    return flow;
}

template <class Id>
Criticality LevelFlow<Id>::kind(std::size_t r) const {
    const Id k = in[r].contours, m = out[r].contours;
    const bool same_genus = in[r].genus == out[r].genus;
    if (k == 0) return Criticality::maximum;
    if (m == 0) return Criticality::minimum;
    if (same_genus && k >= 2 && m == 1) return Criticality::merge;
    if (same_genus && k == 1 && m >= 2) return Criticality::split;
    if (k == 1 && m == 1) return Criticality::genus;
    return Criticality::complex;
}

#define ISOATLAS_LEVELS(Id)                                                                           \
    template BigVector<Id> level_roots(const ContourTree<Id>&, std::span<const double>);              \
    template struct LevelFlow<Id>;                                                                    \
    template LevelFlow<Id> level_flow(const ContourTree<Id>&, std::span<const Id>, std::span<const double>, int);
ISOATLAS_LEVELS(std::uint32_t)
ISOATLAS_LEVELS(std::uint64_t)
#undef ISOATLAS_LEVELS

}  // namespace isoatlas
