#include "geometry/crossings.h"

#include <algorithm>
#include <vector>

#include "base/cancel.h"
#include "base/parallel.h"

namespace isoatlas {

Crossings count_crossings(std::span<const Vec3> points, std::span<const TriangleCorners> triangles, const Context& context) {
    const TriangleTree tree(points, triangles, context.threads);
    const CallerLooks stop(context);
    constexpr std::size_t kLeavesOfABlock = 1024;
    std::vector<Crossings> found((tree.leaves() + kLeavesOfABlock - 1) / kLeavesOfABlock);
    for_each_block(context.threads, static_cast<std::int64_t>(found.size()), [&](std::int64_t block) {
        Crossings here;
        const auto test = [&](std::int64_t s, std::int64_t t) {
            if (!triangles_cross(points, triangles[static_cast<std::size_t>(s)], triangles[static_cast<std::size_t>(t)])) return;
            const std::array<std::int64_t, 2> pair{std::min(s, t), std::max(s, t)};
            ++here.pairs;
            here.first = here.first ? std::min(*here.first, pair) : pair;
        };
        const std::size_t begin = static_cast<std::size_t>(block) * kLeavesOfABlock;
        for (std::size_t leaf = begin; leaf < std::min(begin + kLeavesOfABlock, tree.leaves()); ++leaf) {
            stop();
            const std::span<const std::int64_t> own = tree.leaf(leaf);
            tree.for_each_leaf(tree.leaf_box(leaf), leaf, [&](std::size_t other) {
                const std::span<const std::int64_t> others = tree.leaf(other);
                for (std::size_t i = 0; i < own.size(); ++i)
                    for (std::size_t j = other == leaf ? i + 1 : 0; j < others.size(); ++j) test(own[i], others[j]);
            });
        }
        found[static_cast<std::size_t>(block)] = here;
    });
    Crossings all;
    for (const Crossings& here : found) {
        all.pairs += here.pairs;
        if (here.first) all.first = all.first ? std::min(*all.first, *here.first) : here.first;
    }
    return all;
}

}  // namespace isoatlas
