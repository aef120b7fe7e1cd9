#include "tree/split_tree.h"

#include <algorithm>
#include <numeric>
#include <span>

#include "base/streamed.h"
#include "base/union_find.h"

namespace isoatlas {
namespace {

/// The lower ends of the arcs of every upper end.
template <class Number>
struct LowerEnds {
    using Element = ElementIdOf<Number>;
    ByElement<Number, Number> first;  // position in `end`
    BigVector<Element> end;

    explicit LowerEnds(const ContourTree<Number>& tree) : first(BigVector<Number>(tree.nodes() + 1, Number{0})), end(tree.nodes()) {
        const auto for_arcs = [&](auto&& visit) {
            for (const Element x : streamed<Element>(tree.nodes(), at_random(2))) {
                if (tree.has_arc(x)) visit(tree.upper(x), tree.lower(x));
            }
        };
        for_arcs([&](Element upper, Element) { ++first[upper]; });
        BigVector<Number>& counts = first.items();
        std::exclusive_scan(counts.begin(), counts.end(), counts.begin(), Number{0});
        for_arcs([&](Element upper, Element lower) { end[first[upper]++] = lower; });  // every list now begins where the one before ends
    }
    [[nodiscard]] std::span<const Element> of(Element x) const {
        const std::size_t begin = x == Element(0) ? 0 : first[x.previous()];
        return std::span<const Element>(end).subspan(begin, first[x] - begin);
    }
};

}  // namespace

template <class Number>
SplitTree<Number> split_tree_of(const ContourTree<Number>& contours) {
    using Element = ElementIdOf<Number>;
    const std::size_t n = contours.nodes();
    SplitTree<Number> tree{MergeTree<Number>(n), MergeTree<Number>(n)};
    const LowerEnds<Number> lower(contours);
    UnionFind<Element> sets(n);
    for (const Element x : streamed_down<Element>(n, at_random(4))) {
        tree.parent[x] = tree.lowest[x] = x;
        for (const Element y : lower.of(x)) {
            const Element top = sets.find(y);  // the highest node of its component
            tree.parent[top] = x;
            tree.lowest[x] = std::max(tree.lowest[x], tree.lowest[top]);
            sets.join(x, top);
        }
    }
    return tree;
}

template SplitTree<std::uint32_t> split_tree_of(const ContourTree<std::uint32_t>&);
template SplitTree<std::uint64_t> split_tree_of(const ContourTree<std::uint64_t>&);

}  // namespace isoatlas
