#include "tree/levels.h"

#include <algorithm>
#include <utility>

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
LevelFlow<Id> level_flow(const ContourTree<Id>& tree, std::span<const Id> level, std::span<const double> value) {
    using Signed = std::make_signed_t<Id>;
    const std::size_t n = value.size();
    LevelFlow<Id> flow{BigVector<Id>(n, Id{0}), BigVector<Id>(n, Id{0}), BigVector<Signed>(n, Signed{0})};
    for (std::size_t x = 0; x <= n; ++x) {
        if (!tree.has_arc(x) || !has_length(tree, value, x)) continue;
        const auto genus = static_cast<Signed>(1 - tree.half_chi[x]);
        const std::size_t above = level[tree.upper(x)];
        ++flow.out[above];
        flow.gain[above] += genus;
        if (tree.lower(x) == static_cast<Id>(n)) continue;
        const std::size_t below = level[tree.lower(x)];
        ++flow.in[below];
        flow.gain[below] -= genus;
    }
    return flow;
}

template <class Id>
Criticality LevelFlow<Id>::kind(std::size_t r) const {
    if (in[r] == 0) return Criticality::maximum;
    if (out[r] == 0) return Criticality::minimum;
    if (gain[r] == 0 && in[r] >= 2 && out[r] == 1) return Criticality::merge;
    if (gain[r] == 0 && in[r] == 1 && out[r] >= 2) return Criticality::split;
    if (in[r] == 1 && out[r] == 1) return Criticality::genus;
    return Criticality::complex;
}

#define ISOATLAS_LEVELS(Id)                                                                           \
    template BigVector<Id> level_roots(const ContourTree<Id>&, std::span<const double>);              \
    template struct LevelFlow<Id>;                                                                    \
    template LevelFlow<Id> level_flow(const ContourTree<Id>&, std::span<const Id>, std::span<const double>);
ISOATLAS_LEVELS(std::uint32_t)
ISOATLAS_LEVELS(std::uint64_t)
#undef ISOATLAS_LEVELS

}  // namespace isoatlas
