#include "tree/levels.h"

#include <array>
#include <utility>

#include "base/memory_limit.h"
#include "base/paced_fill.h"
#include "base/union_find.h"

namespace isoatlas {

template <class Id>
BigVector<Id> level_roots(const ContourTree<Id>& tree, std::span<const double> value) {
    const std::size_t n = value.size();
    UnionFind<Id> sets(n);
    BudgetPoll memory;
    for (std::size_t x = 0; x <= n; ++x) {
        memory.step(BudgetPoll::kTouch);
        if (tree.has_arc(x) && !has_length(tree, value, x)) sets.join(tree.upper(x), tree.lower(x));
    }
    return std::move(sets).roots();
}

namespace {

/// Contours in (k) and out (m) of a level, and the change of the sum of its genera.
template <class Id>
struct Balance {
    std::make_signed_t<Id> k, m, genus;

    Balance& operator+=(const Balance& other) {
        k += other.k, m += other.m, genus += other.genus;
        return *this;
    }
};

template <class Id>
LevelKind kind_of(const Balance<Id>& level) {
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
template <class Id>
BigVector<LevelKind> level_kinds(const ContourTree<Id>& tree, std::span<const Id> level, std::span<const double> value,
                                 std::span<const std::int8_t> delta_chi) {
    const std::size_t n = level.size();
    const auto change_of = [&](std::size_t i) { return delta_chi.empty() ? 0 : tree.below(i) - tree.above(i) - delta_chi[i]; };
    const auto balance_of = [&](std::size_t i) { return Balance<Id>{tree.above(i), tree.below(i), change_of(i)}; };
    // An element on its own: there are few different ones.
    std::array<LevelKind, 16 * 8> kinds{};
    for (int degree = 0; degree < 16; ++degree) {
        for (int change = -4; change < 4; ++change) {
            kinds[8 * degree + 4 + change] = kind_of(Balance<Id>{degree & 3, degree >> 2, change});
        }
    }
    BigVector<LevelKind> kind(n);
    BudgetPoll memory;
    for (std::size_t i = 0; i < n; ++i) {
        memory.step();
        kind[i] = kinds[8 * tree.degree[i] + 4 + change_of(i)];
    }
    // Levels of several elements, one run of equal values after the other.
    BigVector<Balance<Id>> balance;  // of few values: nearly all elements
    for (std::size_t first = 0, end = 1; first < n; first = end++) {
        while (end < n && value[end] == value[first]) ++end;
        if (end == first + 1) continue;
        fill_fresh(balance, end - first, Balance<Id>{0, 0, 0});
        for (std::size_t i = first; i < end; ++i) {
            memory.step(BudgetPoll::kTouch);
            Balance<Id>& of = balance[level[i] - first];
            of += balance_of(i);
            if (level[i] != static_cast<Id>(i)) --of.k, --of.m;
        }
        for (std::size_t r = first; r < end; ++r) {
            memory.step(sizeof(Balance<Id>));
            kind[r] = kind_of(balance[r - first]);
        }
    }
    return kind;
}

#define ISOATLAS_LEVELS(Id)                                                                                         \
    template BigVector<Id> level_roots(const ContourTree<Id>&, std::span<const double>);                            \
    template BigVector<LevelKind> level_kinds(const ContourTree<Id>&, std::span<const Id>, std::span<const double>, \
                                              std::span<const std::int8_t>);
ISOATLAS_LEVELS(std::uint32_t)
ISOATLAS_LEVELS(std::uint64_t)
#undef ISOATLAS_LEVELS

}  // namespace isoatlas
