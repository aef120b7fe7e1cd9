// LevelAncestor: ancestors in a tree in O(log n) steps, with one jump pointer a node (Myers 1983, "An applicative random-access stack").
// In the literature: level ancestor queries by jump pointers (Bender, Farach-Colton, The level ancestor problem simplified, 2004).
#pragma once

#include <span>

#include "base/big_vector.h"
#include "base/memory_limit.h"

namespace isoatlas {

template <class Id>
class LevelAncestor {
public:
    /// parent: the root is its own. All parents have larger ids than their children, or all have smaller ones. The span must live as long
    /// as this. Cost: O(n), and as many depths while it runs.
    explicit LevelAncestor(std::span<const Id> parent) : parent_(parent), jump_(parent.size()) {
        const std::size_t n = parent.size();
        if (n == 0) return;
        const bool down = parent[n - 1] == static_cast<Id>(n - 1);  // the root is the last node: go from there
        BigVector<Id> depth(n);
        BudgetPoll memory;
        for (std::size_t k = 0; k < n; ++k) {
            memory.step(2 * BudgetPoll::kTouch);
            const std::size_t x = down ? n - 1 - k : k;
            const Id p = parent[x], far = x == p ? p : jump_[p];
            depth[x] = x == p ? 0 : depth[p] + 1;
            const bool twice = x != p && depth[p] - depth[far] == depth[far] - depth[jump_[far]];
            jump_[x] = twice ? jump_[far] : p;
        }
    }

    /// The last node on the way from x to the root that belongs(node). x belongs; above a node that does not, none does.
    template <class Belongs>
    [[nodiscard]] Id climb(Id x, const Belongs& belongs) const {
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
    std::span<const Id> parent_;
    BigVector<Id> jump_;
};

}  // namespace isoatlas
