#include "zones/paths.h"

#include <limits>

namespace isoatlas {
namespace {

/// Per event its heaviest child (most events above; ties: the higher event), the event itself for a leaf.
template <class Id>
std::vector<Id> heavy_children(const CriticalityTree<Id>& tree) {
    const std::size_t n = tree.size();
    std::vector<Id> weight(n, Id{1}), heavy(n);
    for (std::size_t e = 0; e < n; ++e) heavy[e] = static_cast<Id>(e);
    for (std::size_t e = 0; e < n; ++e) {  // children before parents
        if (tree.is_root(e)) continue;
        const std::size_t p = tree.parent[e];
        weight[p] += weight[e];
        if (heavy[p] == static_cast<Id>(p) || weight[e] > weight[heavy[p]]) heavy[p] = static_cast<Id>(e);
    }
    return heavy;
}

}  // namespace

template <class Id>
HeavyPaths<Id>::HeavyPaths(const CriticalityTree<Id>& tree, std::span<const double> value)
    : values_(tree.size()), events_(tree.size()), place_(tree.size()) {
    const std::vector<Id> heavy = heavy_children(tree);
    Id position = 0;
    for (std::size_t bottom = tree.size(); bottom-- > 0;) {  // parents before children: the place below is known
        const std::size_t parent = tree.parent[bottom];
        const bool root = tree.is_root(bottom);
        if (!root && heavy[parent] == static_cast<Id>(bottom)) continue;
        const auto path = static_cast<Id>(paths_.size());
        paths_.push_back({root ? -std::numeric_limits<double>::infinity() : value[tree.top[parent]], root ? Place{} : place_[parent], position});
        for (std::size_t e = bottom;; e = heavy[e]) {
            place_[e] = {path, position};
            events_[position] = static_cast<Id>(e);
            values_[position++] = value[tree.top[e]];
            if (heavy[e] == static_cast<Id>(e)) break;
        }
    }
}

template class HeavyPaths<std::uint32_t>;
template class HeavyPaths<std::uint64_t>;

}  // namespace isoatlas
