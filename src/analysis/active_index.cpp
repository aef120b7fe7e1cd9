#include "analysis/active_index.h"

#include <algorithm>
#include <ranges>

#include "base/big_vector.h"
#include "base/streamed.h"

namespace isoatlas {

template <class Number>
ActiveZones<Number>::ActiveZones(const AnalysisArrays<Number>& arrays)
    : arrays_(arrays),
      parents_(arrays.tree.parent.items()),
      climber_(arrays.tree.parent),
      highest_(arrays.tree.size()),
      largest_child_(arrays.tree.size()),
      object_voxels_(arrays.tree.size()) {
    const CriticalityTree<Number>& tree = arrays.tree;
    for (const Event e : streamed<Event>(tree.size(), in_order(8))) {
        object_voxels_[e] = e.index() < arrays.voxels.size() ? arrays.voxels[e] : Number{0};
        highest_[e] = largest_child_[e] = e;
    }
    for (const Event e : streamed<Event>(tree.size(), at_random(4))) {  // children come before their parents
        if (tree.is_root(e)) continue;
        const Event p = tree.parent[e];
        object_voxels_[p] += object_voxels_[e];
        highest_[p] = std::min(highest_[p], highest_[e]);
        Event& largest = largest_child_[p];
        if (largest == p || object_voxels_[e] > object_voxels_[largest]) largest = e;
    }
}

template <class Number>
std::size_t ActiveZones<Number>::rank(double tau, bool above) const {
    const auto all = std::views::iota(std::size_t{0}, events());
    const auto first_below =
        std::ranges::partition_point(all, [&](std::size_t e) { return above ? value(Event(e)) > tau : value(Event(e)) >= tau; });
    return static_cast<std::size_t>(first_below - all.begin());
}

template <class Number>
auto ActiveZones<Number>::zones(std::size_t rank) const -> std::vector<Event> {
    std::vector<Event> active;
    if (rank == 0) return active;
    parents_.for_each_at_least(0, rank, Event(rank), [&](std::size_t e) { active.push_back(Event(e)); });
    if (rank == events()) active.push_back(arrays_.tree.root());  // the root is its own parent
    return active;
}

template <class Number>
std::size_t ActiveZones<Number>::element_rank(double tau, bool above) const {
    const BigVector<double>& values = arrays_.value.items();
    const auto first_below = std::ranges::partition_point(values, [=](double v) { return above ? v > tau : v >= tau; });
    return static_cast<std::size_t>(first_below - values.begin());
}

template class ActiveZones<std::uint32_t>;
template class ActiveZones<std::uint64_t>;

}  // namespace isoatlas
