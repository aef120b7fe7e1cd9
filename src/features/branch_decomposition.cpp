#include "features/branch_decomposition.h"

#include <algorithm>
#include <limits>

#include "analysis/object_tree.h"
#include "base/memory_limit.h"
#include "base/paced_fill.h"

namespace isoatlas {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Sums of the zones of every object.
template <class Id>
ObjectSums sum_objects(const ObjectTree<Id>& tree, const ZoneSums& zones) {
    ObjectSums sums{{}, zones.height};
    BudgetPoll memory;
    sums.voxels.resize(tree.size());
    for (std::size_t e = 0; e < tree.size(); ++e) sums.voxels[e] = static_cast<std::int64_t>(tree.voxels[e]), memory.step();
    for (std::size_t e = 0; e < tree.size(); ++e) {
        memory.step(2 * BudgetPoll::kTouch);
        if (tree.is_root(e)) continue;
        sums.voxels[tree.parent[e]] += sums.voxels[e];
        sums.sum[tree.parent[e]] += sums.sum[e];
    }
    return sums;
}

/// Per event: the child whose branch continues, -1: there is none. Children come before their parents.
template <class Id>
BigVector<std::int64_t> continuing_children(const ObjectTree<Id>& tree, std::span<const double> hypervolume) {
    BigVector<std::int64_t> next_above = filled<std::int64_t>(tree.size(), std::int64_t{-1});
    BigVector<double> best = filled<double>(tree.size(), -1.0);
    BudgetPoll memory;
    for (std::size_t e = 0; e < tree.size(); ++e) {
        memory.step(2 * BudgetPoll::kTouch);
        if (tree.is_root(e)) continue;
        const std::size_t p = tree.parent[e];
        if (hypervolume[e] > best[p]) best[p] = hypervolume[e], next_above[p] = static_cast<std::int64_t>(e);
    }
    if (tree.main_leaf < 0) return next_above;
    for (auto e = static_cast<std::size_t>(tree.main_leaf); !tree.is_root(e); e = tree.parent[e])
        next_above[tree.parent[e]] = static_cast<std::int64_t>(e);
    return next_above;
}

/// Per event: event of the highest element of its object.
template <class Id>
BigVector<std::int64_t> highest_events(const ObjectTree<Id>& tree) {
    BigVector<std::int64_t> highest(tree.size());
    BudgetPoll memory;
    for (std::size_t e = 0; e < tree.size(); ++e) highest[e] = static_cast<std::int64_t>(e), memory.step();
    for (std::size_t e = 0; e < tree.size(); ++e) {
        memory.step(BudgetPoll::kTouch);
        if (!tree.is_root(e)) highest[tree.parent[e]] = std::min(highest[tree.parent[e]], highest[e]);
    }
    return highest;
}

}  // namespace

template <class Id>
ZoneSums sum_zones(const ObjectTree<Id>& tree, const VolumeView& volume) {
    ZoneSums zones{BigVector<double>(tree.size(), 0.0), kInfinity};
    BudgetPoll memory;
    tree.for_heights(volume, [&](std::size_t v, double height) {
        memory.step(BudgetPoll::kTouch);
        zones.height[tree.zone[v]] += height;
        zones.lowest = std::min(zones.lowest, height);
    });
    return zones;
}

template <class Id>
BranchDecomposition decompose_branches(const ObjectTree<Id>& tree, const ZoneSums& zones) {
    const std::size_t events = tree.size();
    BranchDecomposition result;
    result.objects = sum_objects(tree, zones);
    result.lowest = zones.lowest;
    BigVector<double> hypervolume(events);
    BudgetPoll memory;
    for (std::size_t e = 0; e < events; ++e) {
        memory.step(BudgetPoll::kTouch);
        const double base = tree.is_root(e) ? result.lowest : tree.height[tree.parent[e]];
        hypervolume[e] = result.objects.sum[e] - static_cast<double>(result.objects.voxels[e]) * base;
    }
    result.highest = highest_events(tree);
    const BigVector<std::int64_t> next_above = continuing_children(tree, hypervolume);
    BigVector<Branch>& branches = result.branch;
    const auto goes_on = [&](std::size_t e) { return !tree.is_root(e) && next_above[tree.parent[e]] == static_cast<std::int64_t>(e); };
    std::size_t count = 0;
    for (std::size_t e = 0; e < events; ++e) count += !goes_on(e), memory.step(BudgetPoll::kTouch);
    branches.reserve(count);  // a growing vector is held twice
    for (std::size_t e = events; e-- > 0;) {
        memory.step(6 * BudgetPoll::kTouch);
        if (goes_on(e)) continue;
        const bool root = tree.is_root(e);
        Branch b{};
        b.bottom = b.top = static_cast<std::int64_t>(e);
        while (next_above[b.top] >= 0) b.top = next_above[b.top], memory.step(BudgetPoll::kTouch);
        b.highest = result.highest[e];
        b.appears = tree.height[b.top];
        b.merges = root ? -kInfinity : tree.height[tree.parent[e]];
        b.hypervolume = hypervolume[e];
        b.persistence = tree.height[b.highest] - (root ? result.lowest : b.merges);
        b.voxels = result.objects.voxels[e];
        branches.push_back(b);
    }
    std::sort(branches.begin() + 1, branches.end(), [&memory](const Branch& p, const Branch& q) {
        memory.step(sizeof(Branch));
        return p.hypervolume != q.hypervolume ? p.hypervolume > q.hypervolume : p.top < q.top;
    });
    result.of_event.resize(events);
    for (std::size_t i = 0; i < branches.size(); ++i) {
        for (std::int64_t e = branches[i].bottom; e >= 0; e = next_above[e]) {
            memory.step(2 * BudgetPoll::kTouch);
            result.of_event[e] = static_cast<std::int64_t>(i);
        }
    }
    for (Branch& b : branches) {
        memory.step(2 * BudgetPoll::kTouch);
        b.parent = tree.is_root(b.bottom) ? -1 : result.of_event[tree.parent[b.bottom]];
    }
    return result;
}

template ZoneSums sum_zones(const ObjectTree<std::uint32_t>&, const VolumeView&);
template ZoneSums sum_zones(const ObjectTree<std::uint64_t>&, const VolumeView&);
template BranchDecomposition decompose_branches(const ObjectTree<std::uint32_t>&, const ZoneSums&);
template BranchDecomposition decompose_branches(const ObjectTree<std::uint64_t>&, const ZoneSums&);

}  // namespace isoatlas
