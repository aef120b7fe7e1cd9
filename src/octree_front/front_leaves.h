// FrontLeaves: the blocks of a front, which together hold the whole surface, each part once.
//
// A leaf is a coalescible block or a cell. Any choice of leaves is a front: neighbours may differ by any number of levels.
//
// The blocks of the greatest level lie in rows along x; a row of them is the work of one thread, and what it writes is its own.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "isoatlas/context.h"
#include "octree_front/coalescible_blocks.h"

namespace isoatlas {

struct FrontLeaf {
    Index3 block;
    int level;
    int pattern;  ///< bit c: corner c is High (field/cell.h)
    [[nodiscard]] std::int64_t width() const { return std::int64_t{1} << level; }
    /// 0 .. 7, x first.
    [[nodiscard]] FrontLeaf child(int i, int with_pattern) const {
        return {{2 * block[0] + (i & 1), 2 * block[1] + (i >> 1 & 1), 2 * block[2] + (i >> 2)}, level - 1, with_pattern};
    }
    /// Are all corners of one class?
    [[nodiscard]] bool is_uniform() const { return pattern == 0 || pattern == 255; }
    /// Of its first corner (octree_front/coalescible_blocks.h).
    [[nodiscard]] Index3 position() const { return {block[0] << level, block[1] << level, block[2] << level}; }
};

class FrontLeaves {
public:
    /// may_stay(leaf): need a coalescible block not be divided? Called by several threads, the same answer each time.
    using MayStay = std::function<bool(const FrontLeaf&)>;

    /// The largest blocks that may stay. blocks: outlives this. Cost: O(leaves).
    FrontLeaves(const CoalescibleBlocks& blocks, const MayStay& may_stay, const Context& context);

    [[nodiscard]] const CoalescibleBlocks& blocks() const { return blocks_; }
    /// Rows of blocks of the greatest level, y first.
    [[nodiscard]] std::int64_t rows() const { return static_cast<std::int64_t>(leaves_.size()); }
    [[nodiscard]] const std::vector<FrontLeaf>& leaves(std::int64_t row) const { return leaves_[static_cast<std::size_t>(row)]; }
    /// Prefetches the classes of the samples of a row.
    void prefetch_samples(std::int64_t row) const { blocks_.prefetch_samples(blocks_.max_level(), row % rows_y_, row / rows_y_); }
    /// Is a block of level 1 or more divided among several leaves? Not one outside.
    [[nodiscard]] bool is_divided(int level, const Index3& block) const { return divided_[static_cast<std::size_t>(level)][block]; }
    /// Divides the leaves of which must_divide(row, index) says so. Returns how many that were.
    std::int64_t divide(const std::function<bool(std::int64_t row, std::size_t index)>& must_divide, const Context& context);

private:
    void find(std::int64_t row, const MayStay& may_stay);
    /// Adds the children of a block that hold a part of the surface.
    template <class Add>
    void for_children(const FrontLeaf& parent, const Add& add) const;

    const CoalescibleBlocks& blocks_;
    std::int64_t rows_y_;
    std::vector<BitGrid> divided_;  ///< by level; empty of level 0
    std::vector<std::vector<FrontLeaf>> leaves_;
};

}  // namespace isoatlas
