#include "tree/split_tree.h"

#include <algorithm>
#include <numeric>
#include <span>

#include "base/memory_limit.h"
#include "base/union_find.h"

namespace isoatlas {
namespace {

/// The lower ends of the arcs of every upper end.
template <class Id>
struct LowerEnds {
    BigVector<Id> first, end;

    explicit LowerEnds(const ContourTree<Id>& tree) : first(tree.nodes() + 1, Id{0}), end(tree.nodes()) {
        BudgetPoll memory;
        const auto for_arcs = [&](auto&& visit) {
            for (std::size_t x = 0; x < tree.nodes(); ++x) {
                memory.step(2 * BudgetPoll::kTouch);
                if (tree.has_arc(x)) visit(tree.upper(x), tree.lower(x));
            }
        };
        for_arcs([&](Id upper, Id) { ++first[upper]; });
        std::exclusive_scan(first.begin(), first.end(), first.begin(), Id{0});
        for_arcs([&](Id upper, Id lower) { end[first[upper]++] = lower; });  // every list now begins where the one before it ends
    }
    [[nodiscard]] std::span<const Id> of(std::size_t x) const {
        const std::size_t begin = x == 0 ? 0 : first[x - 1];
        return std::span<const Id>(end).subspan(begin, first[x] - begin);
    }
};

}  // namespace

template <class Id>
SplitTree<Id> split_tree_of(const ContourTree<Id>& contours) {
    const std::size_t n = contours.nodes();
    SplitTree<Id> tree{BigVector<Id>(n), BigVector<Id>(n)};
    const LowerEnds<Id> lower(contours);
    UnionFind<Id> sets(n);
    BudgetPoll memory;
    for (std::size_t x = n; x-- > 0;) {
        memory.step(4 * BudgetPoll::kTouch);
        tree.parent[x] = tree.lowest[x] = static_cast<Id>(x);
        for (const Id y : lower.of(x)) {
            const Id top = sets.find(y);  // the highest node of its component
            tree.parent[top] = static_cast<Id>(x);
            tree.lowest[x] = std::max(tree.lowest[x], tree.lowest[top]);
            sets.join(static_cast<Id>(x), top);
        }
    }
    return tree;
}

template SplitTree<std::uint32_t> split_tree_of(const ContourTree<std::uint32_t>&);
template SplitTree<std::uint64_t> split_tree_of(const ContourTree<std::uint64_t>&);

}  // namespace isoatlas
