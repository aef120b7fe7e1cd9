// LevelAncestor: ancestors in a tree in O(log n) steps, with one jump pointer a node (Myers 1983, "An applicative random-access stack").
// In the literature: level ancestor queries by jump pointers (Bender, Farach-Colton, The level ancestor problem simplified, 2004).
#pragma once

#include "base/id_array.h"
#include "base/streamed.h"

namespace isoatlas {

/// I: of the nodes.
template <class I>
class LevelAncestor {
public:
    /// parent: the root is its own. All parents have larger ids than their children, or all have smaller ones. The span must live as long
    /// as this. Cost: O(n), and as many depths while it runs.
    explicit LevelAncestor(IdSpan<I, const I> parent) : parent_(parent), jump_(parent.size()) {
        const std::size_t n = parent.size();
        if (n == 0) return;
        const I last(n - 1);
        const bool down = parent[last] == last;  // the root is the last node: go from there
        IdArray<I, typename I::Number> depth(n);
        for (const I x : down ? streamed_down<I>(n, at_random(2)) : streamed<I>(n, at_random(2))) {
            const I p = parent[x], far = x == p ? p : jump_[p];
            depth[x] = x == p ? 0 : depth[p] + 1;
            const bool twice = x != p && depth[p] - depth[far] == depth[far] - depth[jump_[far]];
            jump_[x] = twice ? jump_[far] : p;
        }
    }

    /// The last node on the way from x to the root that belongs(node). x belongs; above a node that does not, none does.
    template <class Belongs>
    [[nodiscard]] I climb(I x, const Belongs& belongs) const {
        for (;;) {
            if (jump_[x] != x && belongs(jump_[x]))
                x = jump_[x];
            else if (parent_[x] != x && belongs(parent_[x]))
                x = parent_[x];
            else
                return x;
        }
    }

private:
    IdSpan<I, const I> parent_;
    IdArray<I, I> jump_;
};

}  // namespace isoatlas
