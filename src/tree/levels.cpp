#include "tree/levels.h"

#include "tree/contour_tree.h"

#include <array>
#include <utility>

#include "base/paced_fill.h"
#include "base/streamed.h"
#include "base/union_find.h"

namespace isoatlas {

template <class Number>
ByElement<Number, ElementIdOf<Number>> level_roots(const ContourTree<Number>& tree, ByElementView<Number, double> value) {
    using Element = ElementIdOf<Number>;
    const std::size_t n = value.size();
    UnionFind<Element> sets(n);
    for (const Element x : streamed<Element>(n, at_random())) {
        if (has_equal(value, x) && tree.has_arc(x) && !has_length(tree, value, x)) sets.join(tree.upper(x), tree.lower(x));
    }
    return MergeTree<Number>(std::move(sets).roots());
}

namespace {

/// Contours in (k) and out (m) of a level, and the change of the sum of its genera.
template <class Number>
struct Balance {
    std::make_signed_t<Number> k, m, genus;

    Balance& operator+=(const Balance& other) {
        k += other.k, m += other.m, genus += other.genus;
        return *this;
    }
};

template <class Number>
LevelKind kind_of(const Balance<Number>& level) {
    const auto [k, m, genus] = level;
    if (k == 0) return LevelKind::maximum;
    if (m == 0) return LevelKind::minimum;
    if (k == 1 && m == 1) return genus == 0 ? LevelKind::trivial : LevelKind::genus;
    if (genus == 0 && m == 1) return LevelKind::merge;
    if (genus == 0 && k == 1) return LevelKind::split;
    return LevelKind::complex;
}

}  // namespace

// The s elements of a level are joined by s - 1 arcs of no length; all other arcs at them are contours. Genus of a contour: 1 - half_chi,
// and the half_chi out are those in plus the delta_chi of the elements.
template <class Number>
ByElement<Number, LevelKind> level_kinds(const ContourTree<Number>& tree, ByElementView<Number, ElementIdOf<Number>> level,
                                         ByElementView<Number, double> value, ByElementView<Number, std::int8_t> delta_chi) {
    using Element = ElementIdOf<Number>;
    const std::size_t n = level.size();
    const auto change_of = [&](Element i) { return delta_chi.empty() ? 0 : tree.below(i) - tree.above(i) - delta_chi[i]; };
    const auto balance_of = [&](Element i) { return Balance<Number>{tree.above(i), tree.below(i), change_of(i)}; };
    // An element on its own: there are few different ones.
    std::array<LevelKind, 16 * 8> kinds{};
    for (int degree = 0; degree < 16; ++degree) {
        for (int change = -4; change < 4; ++change) {
            kinds[8 * degree + 4 + change] = kind_of(Balance<Number>{degree & 3, degree >> 2, change});
        }
    }
    ByElement<Number, LevelKind> kind(n);
    for (const Element i : streamed<Element>(n, in_order(8))) kind[i] = kinds[8 * tree.degree[i] + 4 + change_of(i)];
    // Levels of several elements, one run of equal values after the other.
    BigVector<Balance<Number>> balance;  // of few values: nearly all elements
    StreamedLoops loops;
    for_runs(value.items(), in_order(1), [&](std::size_t first, std::size_t end) {
        if (end == first + 1) return;
        fill_fresh(balance, end - first, Balance<Number>{0, 0, 0});
        loops.over(Element(first), Element(end), at_random(), [&](Element i) {
            Balance<Number>& of = balance[level[i].index() - first];
            of += balance_of(i);
            if (level[i] != i) --of.k, --of.m;
        });
        loops.over(Element(first), Element(end), {sizeof(Balance<Number>)},
                   [&](Element r) { kind[r] = kind_of(balance[r.index() - first]); });
    });
    return kind;
}

#define ISOATLAS_LEVELS(Number)                                                                                                         \
    template MergeTree<Number> level_roots(const ContourTree<Number>&, ByElementView<Number, double>);                                  \
    template ByElement<Number, LevelKind> level_kinds(const ContourTree<Number>&, MergeTreeView<Number>, ByElementView<Number, double>, \
                                                      ByElementView<Number, std::int8_t>);
ISOATLAS_LEVELS(std::uint32_t)
ISOATLAS_LEVELS(std::uint64_t)
#undef ISOATLAS_LEVELS

}  // namespace isoatlas
