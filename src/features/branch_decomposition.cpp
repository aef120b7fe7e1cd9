#include "features/branch_decomposition.h"

#include <algorithm>
#include <limits>

#include "analysis/object_tree.h"
#include "base/paced_fill.h"
#include "base/streamed.h"

namespace isoatlas {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Sums of the zones of every object.
template <class Id>
ObjectSums sum_objects(const ObjectTree<Id>& tree, const ZoneSums& zones) {
    ObjectSums sums{IdArray<EventId, std::int64_t>(tree.size()), zones.height};
    for (const EventId e : streamed<EventId>(tree.size(), in_order(8))) sums.voxels[e] = static_cast<std::int64_t>(tree.voxels[e]);
    for (const EventId e : streamed<EventId>(tree.size(), at_random(2))) {
        if (tree.is_root(e)) continue;
        sums.voxels[tree.parent(e)] += sums.voxels[e];
        sums.sum[tree.parent(e)] += sums.sum[e];
    }
    return sums;
}

/// Of the object of each event just above the height at which it merges.
template <class Id>
IdArray<EventId, double> hypervolumes_of(const ObjectTree<Id>& tree, const ObjectSums& objects, double lowest) {
    IdArray<EventId, double> hypervolume(tree.size());
    for (const EventId e : streamed<EventId>(tree.size(), at_random())) {
        const double base = tree.is_root(e) ? lowest : tree.height[tree.parent(e)];
        hypervolume[e] = objects.sum[e] - static_cast<double>(objects.voxels[e]) * base;
    }
    return hypervolume;
}

/// The child whose branch continues; none: there is no child. Children come before their parents.
template <class Id>
IdArray<EventId, EventId> continuing_children(const ObjectTree<Id>& tree, IdSpan<EventId, const double> hypervolume) {
    IdArray<EventId, EventId> next_above(filled(tree.size(), EventId::none()));
    IdArray<EventId, double> best(filled(tree.size(), -1.0));
    for (const EventId e : streamed<EventId>(tree.size(), at_random(2))) {
        if (tree.is_root(e)) continue;
        const EventId p = tree.parent(e);
        if (hypervolume[e] > best[p]) best[p] = hypervolume[e], next_above[p] = e;
    }
    if (!tree.main_leaf.exists()) return next_above;
    for (EventId e = tree.main_leaf; !tree.is_root(e); e = tree.parent(e)) next_above[tree.parent(e)] = e;
    return next_above;
}

/// Event of the highest element of its object.
template <class Id>
IdArray<EventId, EventId> highest_events(const ObjectTree<Id>& tree) {
    IdArray<EventId, EventId> highest(tree.size());
    for (const EventId e : streamed<EventId>(tree.size(), in_order(8))) highest[e] = e;
    for (const EventId e : streamed<EventId>(tree.size(), at_random())) {
        if (!tree.is_root(e)) highest[tree.parent(e)] = std::min(highest[tree.parent(e)], highest[e]);
    }
    return highest;
}

}  // namespace

template <class Id>
ZoneSums sum_zones(const ObjectTree<Id>& tree, const VolumeView& volume) {
    ZoneSums zones{IdArray<EventId, double>(BigVector<double>(tree.size(), 0.0)), kInfinity};
    tree.for_heights(volume, at_random(), [&](VoxelId v, double height) {
        zones.height[tree.zone(v)] += height;
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
    const IdArray<EventId, double> hypervolume = hypervolumes_of(tree, result.objects, result.lowest);
    result.highest = highest_events(tree);
    const IdArray<EventId, EventId> next_above = continuing_children(tree, hypervolume);
    const auto above = [&](EventId e) { return next_above[e]; };
    IdArray<BranchId, Branch>& branches = result.branch;
    const auto goes_on = [&](EventId e) { return !tree.is_root(e) && next_above[tree.parent(e)] == e; };
    std::size_t count = 0;
    for (const EventId e : streamed<EventId>(events, at_random())) count += !goes_on(e);
    branches.items().reserve(count);  // a growing vector is held twice
    StreamedPaths upwards(at_random());
    for (const EventId e : streamed_down<EventId>(events, at_random(6))) {
        if (goes_on(e)) continue;
        const bool root = tree.is_root(e);
        Branch b{};
        b.bottom = b.top = e;
        for (const EventId higher : upwards.from(next_above[e], above)) b.top = higher;
        b.highest = result.highest[e];
        b.appears = tree.height[b.top];
        b.merges = root ? -kInfinity : tree.height[tree.parent(e)];
        b.hypervolume = hypervolume[e];
        b.persistence = tree.height[b.highest] - (root ? result.lowest : b.merges);
        b.voxels = result.objects.voxels[e];
        branches.push_back(b);
    }
    streamed_sort(branches.items().begin() + 1, branches.items().end(), {sizeof(Branch)}, [](const Branch& p, const Branch& q) {
        return p.hypervolume != q.hypervolume ? p.hypervolume > q.hypervolume : p.top < q.top;
    });
    result.of_event = IdArray<EventId, BranchId>(events);
    StreamedPaths along(at_random(2));
    for (const BranchId i : branches.ids()) {
        for (const EventId e : along.from(branches[i].bottom, above)) result.of_event[e] = i;
    }
    for (const BranchId i : streamed<BranchId>(branches.size(), at_random(2))) {
        Branch& b = branches[i];
        b.parent = tree.is_root(b.bottom) ? BranchId::none() : result.of_event[tree.parent(b.bottom)];
    }
    return result;
}

template ZoneSums sum_zones(const ObjectTree<std::uint32_t>&, const VolumeView&);
template ZoneSums sum_zones(const ObjectTree<std::uint64_t>&, const VolumeView&);
template BranchDecomposition decompose_branches(const ObjectTree<std::uint32_t>&, const ZoneSums&);
template BranchDecomposition decompose_branches(const ObjectTree<std::uint64_t>&, const ZoneSums&);

}  // namespace isoatlas
