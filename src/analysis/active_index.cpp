#include "analysis/active_index.h"

#include <algorithm>
#include <ranges>

#include "base/memory_limit.h"

namespace isoatlas {

template <class Id>
ActiveZones<Id>::ActiveZones(const AnalysisArrays<Id>& arrays)
    : arrays_(arrays),
      parents_(arrays.tree.parent),
      climber_(arrays.tree.parent),
      highest_(arrays.tree.size()),
      largest_child_(arrays.tree.size()),
      object_voxels_(arrays.tree.size()) {
    const CriticalityTree<Id>& tree = arrays.tree;
    BudgetPoll memory;
    for (std::size_t e = 0; e < tree.size(); ++e) {
        memory.step();
        object_voxels_[e] = e < arrays.voxels.size() ? arrays.voxels[e] : Id{0};
        highest_[e] = largest_child_[e] = static_cast<Id>(e);
    }
    for (std::size_t e = 0; e < tree.size(); ++e) {  // children come before their parents
        memory.step(4 * BudgetPoll::kTouch);
        if (tree.is_root(e)) continue;
        const std::size_t p = tree.parent[e];
        object_voxels_[p] += object_voxels_[e];
        highest_[p] = std::min(highest_[p], highest_[e]);
        Id& largest = largest_child_[p];
        if (largest == static_cast<Id>(p) || object_voxels_[e] > object_voxels_[largest]) largest = static_cast<Id>(e);
    }
}

template <class Id>
std::size_t ActiveZones<Id>::rank(double tau, bool above) const {
    const auto all = std::views::iota(std::size_t{0}, events());
    const auto first_below = std::ranges::partition_point(all, [&](std::size_t e) { return above ? value(e) > tau : value(e) >= tau; });
    return static_cast<std::size_t>(first_below - all.begin());
}

template <class Id>
std::vector<Id> ActiveZones<Id>::zones(std::size_t rank) const {
    std::vector<Id> active;
    if (rank == 0) return active;
    parents_.for_each_at_least(0, rank, static_cast<Id>(rank), [&](std::size_t e) { active.push_back(static_cast<Id>(e)); });
    if (rank == events()) active.push_back(static_cast<Id>(rank - 1));  // the root is its own parent
    return active;
}

template <class Id>
std::size_t ActiveZones<Id>::element_rank(double tau, bool above) const {
    const BigVector<double>& values = arrays_.value;
    const auto first_below = std::ranges::partition_point(values, [=](double v) { return above ? v > tau : v >= tau; });
    return static_cast<std::size_t>(first_below - values.begin());
}

template class ActiveZones<std::uint32_t>;
template class ActiveZones<std::uint64_t>;

}  // namespace isoatlas
