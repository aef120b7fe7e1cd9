// Disjoint sets over 0..n-1 with path halving. The caller decides who becomes the root.
#pragma once

#include <cstddef>
#include <utility>

#include "base/big_vector.h"
#include "base/id_array.h"
#include "base/streamed.h"

namespace isoatlas {

/// I: an integer, or an id.
template <class I>
class UnionFind {
public:
    explicit UnionFind(std::size_t count = 0) : parent_(count) {
        for (const std::size_t x : streamed(count, {sizeof(I)})) parent_[x] = static_cast<I>(x);
    }

    [[nodiscard]] I find(I x) {
        while (parent(x) != x) {
            parent(x) = parent(parent(x));
            x = parent(x);
        }
        return x;
    }
    /// root and other must be roots; afterwards root stands for both.
    void attach(I root, I other) { parent(other) = root; }
    /// Joins the sets of a and b; the smaller root wins (deterministic for any order of calls). Returns the root.
    I join(I a, I b) {
        a = find(a);
        b = find(b);
        if (b < a) std::swap(a, b);
        parent(b) = a;
        return a;
    }
    [[nodiscard]] I add() {
        parent_.push_back(static_cast<I>(parent_.size()));
        return parent_.back();
    }
    /// The root of every element.
    [[nodiscard]] BigVector<I> roots() && {
        for (const std::size_t x : streamed(parent_.size(), at_random())) parent_[x] = find(static_cast<I>(x));
        return std::move(parent_);
    }
    [[nodiscard]] std::size_t size() const { return parent_.size(); }

private:
    [[nodiscard]] I& parent(I x) { return parent_[index_of(x)]; }

    BigVector<I> parent_;
};

}  // namespace isoatlas
