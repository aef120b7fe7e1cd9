// Small volumes drawn as trees: inputs of src/tree made by hand. Elements are numbered from the highest down; maxima from 0, minima from 1,
// 0 is the outside.
#pragma once

#include <vector>

#include "critical/critical_set.h"
#include "critical/partitioned_set.h"
#include "field/order.h"
#include "tree/contour_tree.h"
#include "tree/merge_tree.h"

namespace isoatlas {

using Id = std::uint32_t;
using Ids = std::vector<Id>;
using ElementKey = ElementIdOf<Id>;
using EventKey = EventIdOf<Id>;
using DrawnElement = PartitionedElement<Id>;

constexpr DrawnElement drawn(std::array<Id, 2> above, std::array<Id, 2> below, std::uint8_t branches) {
    using Maximum = MaximumIdOf<Id>;
    using Minimum = MinimumIdOf<Id>;
    return {{{Maximum(above[0]), Maximum(above[1])}, {Minimum(below[0]), Minimum(below[1])}}, branches};
}
constexpr DrawnElement peak(Id number, Id low = 0) { return drawn({number, number}, {low, low}, branches_of(0, 1)); }
constexpr DrawnElement pit(Id number, Id high = 0) { return drawn({high, high}, {number, number}, branches_of(1, 0)); }
/// Two objects meet, or one closes to a ring.
constexpr DrawnElement joins(Id a, Id b, Id low = 0) { return drawn({a, b}, {low, low}, branches_of(2, 1)); }
/// A low component falls in two, or a ring is filled.
constexpr DrawnElement parts(Id a, Id b, Id high = 0) { return drawn({high, high}, {a, b}, branches_of(1, 2)); }
constexpr DrawnElement regular(Id high = 0, Id low = 0) { return drawn({high, high}, {low, low}, branches_of(1, 1)); }
/// A saddle in 2D.
constexpr DrawnElement saddle_2d(Id a, Id b, Id c, Id d) { return drawn({a, b}, {c, d}, branches_of(2, 2)); }

/// Arrays of tests as those of the engine.
template <class T>
ByElementView<Id, T> by_element(const std::vector<T>& items) {
    return ByElementView<Id, T>(std::span<const T>(items));
}
inline MergeTreeView<Id> tree_of(const Ids& parent) { return MergeTreeView<Id>(ids_of<ElementKey>(parent)); }

struct Drawing {
    std::vector<DrawnElement> elements;
    std::vector<double> values;
    int rank = 3;

    [[nodiscard]] RepresentedSet<Id> represented_set() const {
        RepresentedSet<Id> set;
        for (const DrawnElement& element : elements) {
            set.branches.push_back(element.branches);
            set.representatives.push_back(element.representatives);
            set.maxima += branches_above(element.branches) == 0;
            set.minima += branches_below(element.branches) == 0;
        }
        return set;
    }
    template <class Number = Id>
    [[nodiscard]] CriticalSet<Number> critical_set() const {
        using Maximum = MaximumIdOf<Number>;
        using Minimum = MinimumIdOf<Number>;
        CriticalSet<Number> set;
        for (std::size_t i = 0; i < elements.size(); ++i) {
            const auto& [representatives, branches] = elements[i];
            const int h0 = branches_above(branches), l0 = branches_below(branches);
            set.value.push_back(values[i]);
            set.code.push_back(ElementCode::vertex(static_cast<std::int64_t>(i), h0, l0, 0).bits);
            const auto& [above, below] = representatives;
            set.up_a.push_back(Maximum(above[0])), set.up_b.push_back(Maximum(above[1]));
            set.low_a.push_back(Minimum(below[0])), set.low_b.push_back(Minimum(below[1]));
            set.maxima += h0 == 0, set.minima += l0 == 0;
        }
        set.rank = rank;
        return set;
    }
    [[nodiscard]] MergeTree<Id> join() const { return join_tree(represented_set()); }
    [[nodiscard]] MergeTree<Id> split() const { return split_tree(represented_set()); }
    [[nodiscard]] ByElementView<Id, double> value() const { return by_element(values); }
    /// In 2D contours have no Euler numbers: empty.
    [[nodiscard]] ByElement<Id, std::int8_t> delta_chi() const {
        ByElement<Id, std::int8_t> change;
        if (rank == 2) return change;
        for (const DrawnElement& element : elements)
            change.push_back(static_cast<std::int8_t>(branches_below(element.branches) - branches_above(element.branches)));
        return change;
    }
    [[nodiscard]] ContourTree<Id> contours() const { return contour_tree<Id>(join(), split(), delta_chi()); }
};

/// Ids as numbers.
template <class I, class T>
auto list(const IdArray<I, T>& array) {
    if constexpr (requires { typename T::Number; }) {
        const std::span<const typename T::Number> numbers = numbers_of<T>(array.items());
        return std::vector<typename T::Number>(numbers.begin(), numbers.end());
    } else {
        return std::vector<T>(array.items().begin(), array.items().end());
    }
}

//   A     B       9  7
//    `-s-'          5
//      |
//   outside
inline Drawing two_peaks() { return {{peak(0), peak(1), joins(0, 1)}, {9, 7, 5}}; }

// A ball that closes around a cavity, which is filled.
//   A             9
//   s             6
//   | `-m           3
//   outside
inline Drawing hollow_ball() { return {{peak(0), parts(0, 1), pit(1)}, {9, 6, 3}}; }

// The islands of docs/theory/3-trees.md#three-trees-of-one-field, in 2D: from `closes` on they lie around a lake.
//   A  B  C       100  82  66
//   `s1'  |         54
//     `s2-'           40
//     closes          22
//     |   `m            10
//   outside
inline Drawing islands() {
    return {{peak(0), peak(1), peak(2), saddle_2d(0, 1, 0, 0), saddle_2d(1, 2, 0, 0), saddle_2d(2, 0, 0, 1), pit(1)},
            {100, 82, 66, 54, 40, 22, 10},
            2};
}

// Two sticks become a ring, which is filled and then closes around a cavity: docs/theory/4-genus.md#t4.
//   A     B       100  90
//    `-2-'          60      genus 0
//      3 handle     58      genus 1
//      4 filled     56      genus 0
//      5            30
//      | `-6          20    minimum
//   outside
inline Drawing body() {
    return {{peak(0), peak(1), joins(0, 1), joins(0, 1), parts(0, 0), parts(0, 1), pit(1)}, {100, 90, 60, 58, 56, 30, 20}};
}

}  // namespace isoatlas
