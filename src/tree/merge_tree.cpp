#include "tree/merge_tree.h"

#include <utility>

#include "base/check.h"
#include "base/union_find.h"
#include "field/order.h"

namespace isoatlas {
namespace {

/// The state of a sweep: components over extrema, and the last node each component met. Side by side: a find ends where it is needed.
template <class Id>
class Sweep {
public:
    Sweep(std::size_t extrema, BigVector<Id>& parent) : components_(extrema), parent_(parent) {}

    void start(Id extremum, Id node) { components_[extremum] = {extremum, node, 1}; }

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

}  // namespace

template <class Id>
BigVector<Id> join_tree(const CriticalSet<Id>& critical) {
    const std::size_t n = critical.size();
    BigVector<Id> parent(n + 1, static_cast<Id>(n));
    Sweep<Id> sweep(static_cast<std::size_t>(critical.maxima), parent);
    for (std::size_t i = 0; i < n; ++i) {
        const int h0 = ElementCode{critical.code[i]}.h0();
        const auto node = static_cast<Id>(i);
        if (h0 == 0) {
            sweep.start(critical.up_a[i], node);
        } else {
            sweep.pass(critical.up_a[i], h0 == 2 ? critical.up_b[i] : critical.up_a[i], node);
        }
    }
    return parent;
}

template <class Id>
BigVector<Id> split_tree(const CriticalSet<Id>& critical) {
    const std::size_t n = critical.size();
    BigVector<Id> parent(n + 1, Id{0});
    Sweep<Id> sweep(static_cast<std::size_t>(critical.minima) + 1, parent);
    sweep.start(Id{0}, static_cast<Id>(n));
    for (std::size_t i = n; i-- > 0;) {
        const int l0 = ElementCode{critical.code[i]}.l0();
        const auto node = static_cast<Id>(i);
        if (l0 == 0) {
            sweep.start(critical.low_a[i], node);
        } else {
            sweep.pass(critical.low_a[i], l0 == 2 ? critical.low_b[i] : critical.low_a[i], node);
        }
    }
    return parent;
}

template BigVector<std::uint32_t> join_tree(const CriticalSet<std::uint32_t>&);
template BigVector<std::uint64_t> join_tree(const CriticalSet<std::uint64_t>&);
template BigVector<std::uint32_t> split_tree(const CriticalSet<std::uint32_t>&);
template BigVector<std::uint64_t> split_tree(const CriticalSet<std::uint64_t>&);

}  // namespace isoatlas
