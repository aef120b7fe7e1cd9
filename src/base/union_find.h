// Disjoint sets over 0..n-1 with path halving. The caller decides who becomes the root.
#pragma once

#include <cstddef>
#include <utility>

#include "base/big_vector.h"
#include "base/memory_limit.h"

namespace isoatlas {

template <class Id>
class UnionFind {
public:
    explicit UnionFind(std::size_t count = 0) : parent_(count) {
        BudgetPoll memory;
        for (std::size_t x = 0; x < count; ++x) parent_[x] = static_cast<Id>(x), memory.step(sizeof(Id));
    }

    [[nodiscard]] Id find(Id x) {
        while (parent_[x] != x) {
            parent_[x] = parent_[parent_[x]];
            x = parent_[x];
        }
        return x;
    }
    /// root and other must be roots; afterwards root stands for both.
    void attach(Id root, Id other) { parent_[other] = root; }
    /// Joins the sets of a and b; the smaller root wins (deterministic for any order of calls). Returns the root.
    Id join(Id a, Id b) {
        a = find(a);
        b = find(b);
        if (b < a) std::swap(a, b);
        parent_[b] = a;
        return a;
    }
    [[nodiscard]] Id add() {
        parent_.push_back(static_cast<Id>(parent_.size()));
        return parent_.back();
    }
    /// The root of every element.
    [[nodiscard]] BigVector<Id> roots() && {
        BudgetPoll memory;
        for (Id x = 0; x < parent_.size(); ++x) parent_[x] = find(x), memory.step(BudgetPoll::kTouch);
        return std::move(parent_);
    }
    [[nodiscard]] std::size_t size() const { return parent_.size(); }

private:
    BigVector<Id> parent_;
};

}  // namespace isoatlas
