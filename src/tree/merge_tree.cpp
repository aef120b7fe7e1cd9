#include "tree/merge_tree.h"

#include <array>
#include <utility>

#include "base/check.h"
#include "base/memory_limit.h"
#include "base/paced_fill.h"
#include "base/prefetch.h"
#include "base/streamed.h"
#include "field/order.h"

namespace isoatlas {
namespace {

constexpr std::size_t kFar = 32, kNear = 12;  // names of a node are fetched so many nodes before, then what they lead to

/// Merge tree of the extremum graph (Lukasczyk et al. 2023): union-find over maxima (split tree: minima), with the last node that each
/// component met. Side by side: a find ends where it is needed.
template <class Number, class Extremum>
class Sweep {
public:
    using Element = ElementIdOf<Number>;

    Sweep(std::size_t extrema, MergeTree<Number>& parent) : parent_(parent) {
        const PinInMemory keep;
        components_ = decltype(components_)(filled(extrema, Component{kRoot, Element(0)}));
    }

    void start(Extremum extremum, Element node) { components_[extremum] = {kRoot | 1, node}; }

    void fetch(const std::array<Extremum, 2>& names) const {
        for (const Extremum name : names) prefetch_to_write(&components_[name]);
    }
    void fetch_roots(const std::array<Extremum, 2>& names) const {
        for (const Extremum name : names) {
            const Component& component = components_[name];
            prefetch_to_write(is_root(component) ? static_cast<const void*>(&parent_[component.last])
                                                 : static_cast<const void*>(&components_[Extremum(component.link)]));
        }
    }

    /// A node with so many branches: a leaf starts the component of its representative.
    void meet(int branches, const std::array<Extremum, 2>& names, Element node) {
        if (branches == 0) {
            start(names[0], node);
        } else {
            pass(names[0], names[branches - 1], node);
        }
    }

    /// The component of a passes node; b joins it when it is another one.
    void pass(Extremum a, Extremum b, Element node) {
        a = find(a);
        parent_[components_[a].last] = node;
        if (b = find(b); b != a) {
            parent_[components_[b].last] = node;
            if (components_[a].link < components_[b].link) std::swap(a, b);
            components_[a].link += components_[b].link & ~kRoot;
            components_[b].link = a.number();
        }
        components_[a].last = node;
    }

private:
    static constexpr Number kRoot = Number{1} << (8 * sizeof(Number) - 1);
    struct Component {
        Number link;  ///< of a root: kRoot and how many extrema it stands for; else the way to it
        Element last;
    };
    [[nodiscard]] static bool is_root(const Component& component) { return (component.link & kRoot) != 0; }

    Extremum find(Extremum x) {
        while (!is_root(components_[x])) {
            const Extremum next(components_[x].link);
            if (is_root(components_[next])) return next;
            components_[x].link = components_[next].link;
            x = Extremum(components_[x].link);
        }
        return x;
    }

    IdArray<Extremum, Component> components_;
    MergeTree<Number>& parent_;
};

/// count(i): branches of element i on the side that is swept first; names(i): representatives of their components.
template <class Number, class Count, class Names>
MergeTree<Number> sweep_down(std::size_t n, std::size_t maxima, const Count& count, const Names& names) {
    using Element = ElementIdOf<Number>;
    MergeTree<Number> parent(filled(n + 1, Element(n)));
    Sweep<Number, MaximumIdOf<Number>> sweep(maxima, parent);
    for (const Element i : streamed<Element>(n, in_order(8))) {
        if (i.index() + kFar < n) sweep.fetch(names(Element(i.index() + kFar)));
        if (i.index() + kNear < n) sweep.fetch_roots(names(Element(i.index() + kNear)));
        sweep.meet(count(i), names(i), i);
    }
    return parent;
}

template <class Number, class Count, class Names>
MergeTree<Number> sweep_up(std::size_t n, std::size_t minima, const Count& count, const Names& names) {
    using Element = ElementIdOf<Number>;
    using Minimum = MinimumIdOf<Number>;
    MergeTree<Number> parent(filled(n + 1, Element(0)));
    Sweep<Number, Minimum> sweep(minima + 1, parent);
    sweep.start(Minimum(0), Element(n));  // the outside
    for (const Element i : streamed_down<Element>(n, in_order(8))) {
        if (i.index() >= kFar) sweep.fetch(names(Element(i.index() - kFar)));
        if (i.index() >= kNear) sweep.fetch_roots(names(Element(i.index() - kNear)));
        sweep.meet(count(i), names(i), i);
    }
    return parent;
}

}  // namespace

template <class Number>
MergeTree<Number> join_tree(const CriticalSet<Number>& set) {
    using Element = ElementIdOf<Number>;
    return sweep_down<Number>(
        set.size(), static_cast<std::size_t>(set.maxima), [&](Element i) { return ElementCode{set.code[i]}.h0(); },
        [&](Element i) { return std::array{set.up_a[i], set.up_b[i]}; });
}

template <class Number>
MergeTree<Number> split_tree(const CriticalSet<Number>& set) {
    using Element = ElementIdOf<Number>;
    return sweep_up<Number>(
        set.size(), static_cast<std::size_t>(set.minima), [&](Element i) { return ElementCode{set.code[i]}.l0(); },
        [&](Element i) { return std::array{set.low_a[i], set.low_b[i]}; });
}

template <class Number>
MergeTree<Number> join_tree(const RepresentedSet<Number>& set) {
    using Element = ElementIdOf<Number>;
    return sweep_down<Number>(
        set.size(), set.maxima, [&](Element i) { return branches_above(set.branches[i]); },
        [&](Element i) { return set.representatives[i].above; });
}

template <class Number>
MergeTree<Number> split_tree(const RepresentedSet<Number>& set) {
    using Element = ElementIdOf<Number>;
    return sweep_up<Number>(
        set.size(), set.minima, [&](Element i) { return branches_below(set.branches[i]); },
        [&](Element i) { return set.representatives[i].below; });
}

#define ISOATLAS_MERGE_TREE(Number)                                      \
    template MergeTree<Number> join_tree(const CriticalSet<Number>&);    \
    template MergeTree<Number> split_tree(const CriticalSet<Number>&);   \
    template MergeTree<Number> join_tree(const RepresentedSet<Number>&); \
    template MergeTree<Number> split_tree(const RepresentedSet<Number>&);
ISOATLAS_MERGE_TREE(std::uint32_t)
ISOATLAS_MERGE_TREE(std::uint64_t)
#undef ISOATLAS_MERGE_TREE

}  // namespace isoatlas
