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
BigVector<LevelFlow<Id>> level_flow(const ContourTree<Id>& tree, std::span<const Id> level, std::span<const double> value) {
    using Signed = std::make_signed_t<Id>;
    const std::size_t n = value.size();
    BigVector<LevelFlow<Id>> flow(n, LevelFlow<Id>{0, 0, 0});
    for (std::size_t x = 0; x <= n; ++x) {
        if (!tree.has_arc(x) || !has_length(tree, value, x)) continue;
        const auto genus = static_cast<Signed>(1 - tree.half_chi[x]);
        LevelFlow<Id>& above = flow[level[tree.upper(x)]];
        ++above.out;
        above.gain += genus;
        if (tree.lower(x) == static_cast<Id>(n)) continue;
        LevelFlow<Id>& below = flow[level[tree.lower(x)]];
        ++below.in;
        below.gain -= genus;
    }
    return flow;
}

template <class Id>
Criticality LevelFlow<Id>::kind() const {
    if (in == 0) return Criticality::maximum;
    if (out == 0) return Criticality::minimum;
    if (gain == 0 && in >= 2 && out == 1) return Criticality::merge;
    if (gain == 0 && in == 1 && out >= 2) return Criticality::split;
    if (in == 1 && out == 1) return Criticality::genus;
    return Criticality::complex;
}

#define ISOATLAS_LEVELS(Id)                                                                           \
    template BigVector<Id> level_roots(const ContourTree<Id>&, std::span<const double>);              \
    template struct LevelFlow<Id>;                                                                    \
    template BigVector<LevelFlow<Id>> level_flow(const ContourTree<Id>&, std::span<const Id>, std::span<const double>);
ISOATLAS_LEVELS(std::uint32_t)
ISOATLAS_LEVELS(std::uint64_t)
#undef ISOATLAS_LEVELS

}  // namespace isoatlas
