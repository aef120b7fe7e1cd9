#include "octree_front/front_leaves.h"

#include <array>
#include <numeric>

#include "field/slab_work.h"
#include "octree_front/front_phases.h"

namespace isoatlas {

template <class Add>
void FrontLeaves::for_children(const FrontLeaf& parent, const Add& add) const {
    const Index3& size = blocks_.blocks(parent.level - 1);
    const std::array<std::uint8_t, 8> patterns = blocks_.child_patterns(parent.level, parent.block);
    for (int child = 0; child < 8; ++child) {
        const FrontLeaf leaf = parent.child(child, patterns[child]);
        if (leaf.block[0] < size[0] && leaf.block[1] < size[1] && leaf.block[2] < size[2]) add(leaf);
    }
}

FrontLeaves::FrontLeaves(const CoalescibleBlocks& blocks, const MayStay& may_stay, const Context& context)
    : blocks_(blocks), rows_y_(blocks.blocks(blocks.max_level())[1]) {
    divided_.resize(static_cast<std::size_t>(blocks.max_level()) + 1);
    for (int level = 1; level <= blocks.max_level(); ++level)
        divided_[static_cast<std::size_t>(level)] = BitGrid(blocks.blocks(level), false);
    leaves_.resize(static_cast<std::size_t>(rows_y_ * blocks.blocks(blocks.max_level())[2]));
    for_each_slab_of(1, context, kFrontPhases["leaves"], rows(), [&](const Slab& row) { find(row.z_begin, may_stay); });
}

void FrontLeaves::find(std::int64_t row, const MayStay& may_stay) {
    std::vector<FrontLeaf> divided;
    std::vector<FrontLeaf>& leaves = leaves_[static_cast<std::size_t>(row)];
    const auto look_at = [&](const FrontLeaf& block) {
        if (block.level > 0 && !blocks_.is_coalescible(block.level, block.block)) {
            divided.push_back(block);
        } else if (!block.is_uniform()) {  // else all its vertices are of one class
            (block.level == 0 || may_stay(block) ? leaves : divided).push_back(block);
        }
    };
    const int top = blocks_.max_level();
    for (std::int64_t x = 0; x < blocks_.blocks(top)[0]; ++x) {
        const Index3 first{x, row % rows_y_, row / rows_y_};
        look_at({first, top, blocks_.pattern(top, first)});
        while (!divided.empty()) {
            const FrontLeaf block = divided.back();
            divided.pop_back();
            divided_[static_cast<std::size_t>(block.level)].set(block.block);
            for_children(block, look_at);
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
                if (!child.is_uniform()) now.push_back(child);
            });
        }
        leaves.swap(now);
    });
    return std::accumulate(divided.begin(), divided.end(), std::int64_t{0});
}

}  // namespace isoatlas
