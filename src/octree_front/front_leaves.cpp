#include "octree_front/front_leaves.h"

#include <numeric>

#include "field/slab_work.h"
#include "octree_front/front_phases.h"

namespace isoatlas {

template <class Add>
void FrontLeaves::for_children(const FrontLeaf& parent, const Add& add) const {
    const Index3& size = blocks_.blocks(parent.level - 1);
    for (int child = 0; child < 8; ++child) {
        const FrontLeaf leaf{{2 * parent.block[0] + (child & 1), 2 * parent.block[1] + (child >> 1 & 1), 2 * parent.block[2] + (child >> 2)},
                             parent.level - 1};
        if (leaf.block[0] < size[0] && leaf.block[1] < size[1] && leaf.block[2] < size[2]) add(leaf);
    }
}

FrontLeaves::FrontLeaves(const CoalescibleBlocks& blocks, const MayStay& may_stay, const Context& context)
    : blocks_(blocks), rows_y_(blocks.blocks(blocks.max_level())[1]) {
    divided_.resize(static_cast<std::size_t>(blocks.max_level()) + 1);
    for (int level = 1; level <= blocks.max_level(); ++level) divided_[static_cast<std::size_t>(level)] = BitGrid(blocks.blocks(level), false);
    leaves_.resize(static_cast<std::size_t>(rows_y_ * blocks.blocks(blocks.max_level())[2]));
    for_each_slab_of(1, context, kFrontPhases["leaves"], rows(), [&](const Slab& row) { find(row.z_begin, may_stay); });
}

void FrontLeaves::find(std::int64_t row, const MayStay& may_stay) {
    std::vector<FrontLeaf> pending;
    for (std::int64_t x = 0; x < blocks_.blocks(blocks_.max_level())[0]; ++x) {
        pending.push_back({{x, row % rows_y_, row / rows_y_}, blocks_.max_level()});
        while (!pending.empty()) {
            const FrontLeaf block = pending.back();
            pending.pop_back();
            const bool is_coalescible = blocks_.is_coalescible(block.level, block.block);
            if (block.level == 0 || is_coalescible) {
                const int pattern = blocks_.pattern(block.level, block.block);
                if (pattern == 0 || pattern == 255) continue;  // of a coalescible block: so are all its vertices
                if (block.level == 0 || may_stay(block)) {
                    leaves_[static_cast<std::size_t>(row)].push_back(block);
                    continue;
                }
            }
            divided_[static_cast<std::size_t>(block.level)].set(block.block);
            for_children(block, [&](const FrontLeaf& child) { pending.push_back(child); });
        }
    }
}

std::int64_t FrontLeaves::divide(const std::function<bool(std::int64_t, std::size_t)>& must_divide, const Context& context) {
    std::vector<std::int64_t> divided(leaves_.size(), 0);
    for_each_slab_of(1, context, kFrontPhases["leaves"], rows(), [&](const Slab& slab) {
        const std::int64_t row = slab.z_begin;
        std::vector<FrontLeaf>& leaves = leaves_[static_cast<std::size_t>(row)];
        std::vector<FrontLeaf> now;
        for (std::size_t i = 0; i < leaves.size(); ++i) {
            if (!must_divide(row, i)) {
                now.push_back(leaves[i]);
                continue;
            }
            ++divided[static_cast<std::size_t>(row)];
            divided_[static_cast<std::size_t>(leaves[i].level)].set(leaves[i].block);
            for_children(leaves[i], [&](const FrontLeaf& child) {
                const int pattern = blocks_.pattern(child.level, child.block);
                if (pattern != 0 && pattern != 255) now.push_back(child);
            });
        }
        leaves.swap(now);
    });
    return std::accumulate(divided.begin(), divided.end(), std::int64_t{0});
}

}  // namespace isoatlas
