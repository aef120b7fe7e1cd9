#include "tree/levels.h"

#include "base/union_find.h"

namespace isoatlas {

template <class Id>
Criticality Levels<Id>::kind(std::size_t r) const {
    if (in[r] == 0) return Criticality::maximum;
    if (out[r] == 0) return Criticality::minimum;
    if (gain[r] == 0 && in[r] >= 2 && out[r] == 1) return Criticality::merge;
    if (gain[r] == 0 && in[r] == 1 && out[r] >= 2) return Criticality::split;
    if (in[r] == 1 && out[r] == 1) return Criticality::genus;
    return Criticality::complex;
}

template <class Id>
Levels<Id> contract_levels(const ContourTree<Id>& tree, std::span<const double> value) {
    using Signed = std::make_signed_t<Id>;
    const std::size_t n = value.size();
    UnionFind<Id> sets(n);
    const auto has_length = [&](std::size_t x) {
        const std::size_t lower = tree.lower(x);
        return lower == n || value[tree.upper(x)] != value[lower];
    };
    for (std::size_t x = 0; x <= n; ++x) {
        if (tree.has_arc(x) && !has_length(x)) sets.join(tree.upper(x), tree.lower(x));
    }
    Levels<Id> levels;
    levels.root.resize(n);
    for (std::size_t i = 0; i < n; ++i) levels.root[i] = sets.find(static_cast<Id>(i));
    levels.in.resize(n);
    levels.out.resize(n);
    levels.gain.resize(n);
    for (std::size_t x = 0; x <= n; ++x) {
        if (!tree.has_arc(x) || !has_length(x)) continue;
        const auto genus = static_cast<Signed>(1 - tree.half_chi[x]);
        const std::size_t above = levels.root[tree.upper(x)];
        ++levels.out[above];
        levels.gain[above] += genus;
        if (tree.lower(x) == static_cast<Id>(n)) continue;
        const std::size_t below = levels.root[tree.lower(x)];
        ++levels.in[below];
        levels.gain[below] -= genus;
    }
    return levels;
}

template struct Levels<std::uint32_t>;
template struct Levels<std::uint64_t>;
template Levels<std::uint32_t> contract_levels(const ContourTree<std::uint32_t>&, std::span<const double>);
template Levels<std::uint64_t> contract_levels(const ContourTree<std::uint64_t>&, std::span<const double>);

}  // namespace isoatlas
