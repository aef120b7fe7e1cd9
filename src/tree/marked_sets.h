// The components of a sweep: disjoint sets with a mark each. Root and mark lie side by side, because a find ends where the mark is needed.
// No UnionFind (base/union_find.h): its roots are chosen by their ids, need no sizes, and take a third of this memory.
// In the literature: disjoint sets, union-find (Tarjan, Efficiency of a good but not linear set union algorithm, 1975).
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace isoatlas {

template <class Number, class Allocator = std::allocator<std::byte>>
class MarkedSets {
public:
    /// mark(c): of c on its own.
    template <class Mark>
    void start(std::size_t count, const Mark& mark) {
        components_.resize(count);
        for (std::size_t c = 0; c < count; ++c) components_[c] = {static_cast<Number>(c), 1, mark(static_cast<Number>(c))};
    }
    [[nodiscard]] Number find(Number c) {
        while (components_[c].root != c) {
            components_[c].root = components_[components_[c].root].root;
            c = components_[c].root;
        }
        return c;
    }
    /// a, b: roots, may be equal. Returns the root of both, which has the mark of one of them.
    Number join(Number a, Number b) {
        if (a == b) return a;
        if (components_[a].size < components_[b].size) std::swap(a, b);
        components_[b].root = a;
        components_[a].size += components_[b].size;
        return a;
    }
    [[nodiscard]] Number& mark(Number root) { return components_[root].mark; }

private:
    struct Component {
        Number root, size, mark;
    };
    std::vector<Component, typename std::allocator_traits<Allocator>::template rebind_alloc<Component>> components_;
};

}  // namespace isoatlas
