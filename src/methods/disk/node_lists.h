// NodeLists: how many entries of a node each of its lists has, and each of its children.
#pragma once

#include <cstdint>
#include <numeric>
#include <vector>

#include "methods/disk/corner_structure.h"
#include "methods/disk/interval_tree_format.h"

namespace isoatlas {

/// Where an entry belongs: p == q: to a child.
struct SlabPair {
    int p, q;
    [[nodiscard]] bool is_inside() const { return p == q; }
    [[nodiscard]] bool spans_slabs() const { return q - p > 1; }
};

class NodeLists {
public:
    NodeLists(int slabs, std::int64_t in_block) : slabs_(slabs), in_block_(in_block) {
        const auto n = static_cast<std::size_t>(slabs);
        inside.assign(n, 0), left.assign(n, 0), right.assign(n, 0), multi.assign((n - 1) * (n - 2) / 2, 0);
    }
    void count(const SlabPair& slabs) {
        const auto p = static_cast<std::size_t>(slabs.p), q = static_cast<std::size_t>(slabs.q);
        if (slabs.is_inside()) {
            ++inside[p];
            return;
        }
        ++left[p], ++right[q], ++own;
        if (slabs.spans_slabs()) ++multi[multi_of(slabs)];
    }
    /// The list of the slabs between both ends.
    [[nodiscard]] std::size_t multi_of(const SlabPair& slabs) const { return place_of_multi(slabs.p + 1, slabs.q - 1, slabs_); }
    /// Is it kept in the corner structure? Reading half a block of active entries is worth it.
    [[nodiscard]] bool is_short(std::size_t list) const { return 2 * multi[list] < in_block_; }
    [[nodiscard]] CornerStructure corner() const {
        return {slabs_, in_block_, [this](int p, int q) {
                    const std::size_t list = place_of_multi(p, q, slabs_);
                    return is_short(list) ? multi[list] : 0;
                }};
    }

    std::vector<std::int64_t> inside, left, right, multi;
    std::int64_t own = 0;

private:
    int slabs_;
    std::int64_t in_block_;
};

}  // namespace isoatlas
