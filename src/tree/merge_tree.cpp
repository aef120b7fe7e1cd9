#include "tree/merge_tree.h"

#include <array>
#include <utility>

#include "base/check.h"
#include "base/memory_limit.h"
#include "base/paced_fill.h"
#include "base/union_find.h"
#include "field/order.h"

namespace isoatlas {
namespace {

/// Merge tree of the extremum graph (Lukasczyk et al. 2023): union-find over maxima (split tree: minima), with the last node that each
/// component met. Side by side: a find ends where it is needed.
template <class Id>
class Sweep {
public:
    Sweep(std::size_t extrema, BigVector<Id>& parent) : parent_(parent) {
        const PinInMemory keep;
        components_.resize(extrema);
    }

    void start(Id extremum, Id node) { components_[extremum] = {extremum, node, 1}; }

    /// A node with so many branches: a leaf starts the component of its representative.
    void meet(int branches, const std::array<Id, 2>& names, Id node) {
        if (branches == 0) {
            start(names[0], node);
        } else {
            pass(names[0], names[branches - 1], node);
        }
    }

    /// The component of a passes node; b joins it when it is another one.
    void pass(Id a, Id b, Id node) {
        a = find(a);
        parent_[components_[a].last] = node;
        if (b = find(b); b != a) {
            parent_[components_[b].last] = node;
            if (components_[a].size < components_[b].size) std::swap(a, b);
            components_[b].root = a;
            components_[a].size += components_[b].size;
        }
        components_[a].last = node;
    }

private:
    struct Component {
        Id root, last, size;
    };

    Id find(Id x) {
        while (components_[x].root != x) {
            components_[x].root = components_[components_[x].root].root;
            x = components_[x].root;
        }
        return x;
    }

    BigVector<Component> components_;
    BigVector<Id>& parent_;
};

/// count(i): branches of element i on the side that is swept first; names(i): representatives of their components.
template <class Id, class Count, class Names>
BigVector<Id> sweep_down(std::size_t n, std::size_t extrema, const Count& count, const Names& names) {
    BigVector<Id> parent = filled<Id>(n + 1, static_cast<Id>(n));
    Sweep<Id> sweep(extrema, parent);
    BudgetPoll memory;
    for (std::size_t i = 0; i < n; ++i) {
        memory.step();
        sweep.meet(count(i), names(i), static_cast<Id>(i));
    }
    return parent;
}

template <class Id, class Count, class Names>
BigVector<Id> sweep_up(std::size_t n, std::size_t extrema, const Count& count, const Names& names) {
    BigVector<Id> parent = filled<Id>(n + 1, Id{0});
    Sweep<Id> sweep(extrema, parent);
    sweep.start(Id{0}, static_cast<Id>(n));  // the outside
    BudgetPoll memory;
    for (std::size_t i = n; i-- > 0;) {
        memory.step();
        sweep.meet(count(i), names(i), static_cast<Id>(i));
    }
    return parent;
}

}  // namespace

template <class Id>
BigVector<Id> join_tree(const CriticalSet<Id>& set) {
    return sweep_down<Id>(
        set.size(), static_cast<std::size_t>(set.maxima), [&](std::size_t i) { return ElementCode{set.code[i]}.h0(); },
        [&](std::size_t i) { return std::array{set.up_a[i], set.up_b[i]}; });
}

template <class Id>
BigVector<Id> split_tree(const CriticalSet<Id>& set) {
    return sweep_up<Id>(
        set.size(), static_cast<std::size_t>(set.minima) + 1, [&](std::size_t i) { return ElementCode{set.code[i]}.l0(); },
        [&](std::size_t i) { return std::array{set.low_a[i], set.low_b[i]}; });
}

template <class Id>
BigVector<Id> join_tree(const RepresentedSet<Id>& set) {
    return sweep_down<Id>(
        set.size(), set.maxima, [&](std::size_t i) { return branches_above(set.branches[i]); },
        [&](std::size_t i) { return set.representatives[i].above; });
}

template <class Id>
BigVector<Id> split_tree(const RepresentedSet<Id>& set) {
    return sweep_up<Id>(
        set.size(), set.minima + 1, [&](std::size_t i) { return branches_below(set.branches[i]); },
        [&](std::size_t i) { return set.representatives[i].below; });
}

#define ISOATLAS_MERGE_TREE(Id)                                  \
    template BigVector<Id> join_tree(const CriticalSet<Id>&);    \
    template BigVector<Id> split_tree(const CriticalSet<Id>&);   \
    template BigVector<Id> join_tree(const RepresentedSet<Id>&); \
    template BigVector<Id> split_tree(const RepresentedSet<Id>&);
ISOATLAS_MERGE_TREE(std::uint32_t)
ISOATLAS_MERGE_TREE(std::uint64_t)
#undef ISOATLAS_MERGE_TREE

}  // namespace isoatlas
