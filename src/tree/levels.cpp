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

namespace {

/// One side of every level: its contours, counted to two, and the sum of their genera.
template <class Id>
struct Side {
    BigVector<std::uint8_t> contours;
    BigVector<std::make_signed_t<Id>> genus;
};

/// end_of(arc): the element at that end of the arc.
template <class Id, class EndOf>
Side<Id> gather_side(const ContourTree<Id>& tree, std::span<const Id> level, std::span<const double> value, const EndOf& end_of) {
    using Signed = std::make_signed_t<Id>;
    const std::size_t n = value.size();
    Side<Id> side{BigVector<std::uint8_t>(n, std::uint8_t{0}), BigVector<Signed>(n, Signed{0})};
    for (std::size_t x = 0; x <= n; ++x) {
        if (!tree.has_arc(x) || !has_length(tree, value, x)) continue;
        const std::size_t element = end_of(x);
        if (element == n) continue;  // the outside
        const std::size_t root = level[element];
        side.contours[root] = static_cast<std::uint8_t>(std::min(side.contours[root] + 1, 2));
        side.genus[root] += 1 - tree.half_chi[x];
    }
    return side;
}

LevelKind kind_of(int k, int m, bool same_genus) {
    if (k == 0) return LevelKind::maximum;
    if (m == 0) return LevelKind::minimum;
    if (k == 1 && m == 1) return same_genus ? LevelKind::trivial : LevelKind::genus;
    if (same_genus && m == 1) return LevelKind::merge;
    if (same_genus && k == 1) return LevelKind::split;
    return LevelKind::complex;
}

}  // namespace

template <class Id>
BigVector<LevelKind> level_kinds(const ContourTree<Id>& tree, std::span<const Id> level, std::span<const double> value, int threads) {
    Side<Id> in, out;
    run_both(
        threads, [&] { in = gather_side<Id>(tree, level, value, [&](std::size_t x) { return tree.lower(x); }); },
        [&] { out = gather_side<Id>(tree, level, value, [&](std::size_t x) { return tree.upper(x); }); });
    BigVector<LevelKind> kind(value.size());
    for (std::size_t r = 0; r < kind.size(); ++r) kind[r] = kind_of(in.contours[r], out.contours[r], in.genus[r] == out.genus[r]);
    return kind;
}

#define ISOATLAS_LEVELS(Id)                                                              \
    template BigVector<Id> level_roots(const ContourTree<Id>&, std::span<const double>); \
    template BigVector<LevelKind> level_kinds(const ContourTree<Id>&, std::span<const Id>, std::span<const double>, int);
ISOATLAS_LEVELS(std::uint32_t)
ISOATLAS_LEVELS(std::uint64_t)
#undef ISOATLAS_LEVELS

}  // namespace isoatlas
