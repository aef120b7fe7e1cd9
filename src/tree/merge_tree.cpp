#include "tree/merge_tree.h"

#include <utility>

#include "base/check.h"
#include "base/union_find.h"
#include "field/order.h"

namespace isoatlas {
namespace {

/// The state of a sweep: components over extrema, and the last node each component met.
template <class Id>
class Sweep {
public:
    Sweep(std::size_t extrema, BigVector<Id>& parent) : components_(extrema), last_(extrema), parent_(parent) {}

    void start(Id extremum, Id node) { last_[extremum] = node; }

    /// The component of a passes node; b joins it when it is another one.
    void pass(Id a, Id b, Id node) {
        a = components_.find(a);
        parent_[last_[a]] = node;
        if (b = components_.find(b); b != a) {
            parent_[last_[b]] = node;
            components_.attach(a, b);
        }
        last_[a] = node;
    }
    [[nodiscard]] Id last_of(Id extremum) { return last_[components_.find(extremum)]; }

private:
    UnionFind<Id> components_;
    BigVector<Id> last_;
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
