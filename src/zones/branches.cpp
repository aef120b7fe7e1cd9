#include "zones/branches.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace isoatlas {
namespace {

template <class Id>
double value_of(const AnalysisArrays<Id>& arrays, std::size_t event) {
    return arrays.value[arrays.tree.top[event]];
}

template <class Id>
ObjectSums sum_objects(const AnalysisArrays<Id>& arrays, std::span<const double> zone_sum) {
    ObjectSums sums{{arrays.voxels.begin(), arrays.voxels.end()}, {zone_sum.begin(), zone_sum.end()}};
    for (std::size_t e = 0; e < arrays.tree.size(); ++e) {
        if (arrays.tree.is_root(e)) continue;
        sums.voxels[arrays.tree.parent[e]] += sums.voxels[e];
        sums.sum[arrays.tree.parent[e]] += sums.sum[e];
    }
    return sums;
}

}  // namespace

template <class Id>
Branches make_branches(const AnalysisArrays<Id>& arrays, std::span<const double> zone_sum, double lowest) {
    const auto& tree = arrays.tree;
    const std::size_t events = tree.size();
    Branches result;
    result.objects = sum_objects(arrays, zone_sum);
    const ObjectSums& sums = result.objects;
    const auto hypervolume = [&](std::size_t e) {
        const double base = tree.is_root(e) ? lowest : value_of(arrays, tree.parent[e]);
        return sums.sum[e] - static_cast<double>(sums.voxels[e]) * base;
    };
    // The child that goes on, and the highest event of the object; children come before their parents.
    BigVector<std::int64_t> next_above(events, std::int64_t{-1});
    BigVector<double> best(events, -1.0);
    result.highest.resize(events);
    std::iota(result.highest.begin(), result.highest.end(), std::int64_t{0});
    for (std::size_t e = 0; e < events; ++e) {
        if (tree.is_root(e)) continue;
        const std::size_t p = tree.parent[e];
        result.highest[p] = std::min(result.highest[p], result.highest[e]);
        if (const double h = hypervolume(e); h > best[p]) best[p] = h, next_above[p] = static_cast<std::int64_t>(e);
    }
    BigVector<Branch>& branches = result.branch;
    for (std::size_t e = events; e-- > 0;) {
        const bool root = tree.is_root(e);
        if (!root && next_above[tree.parent[e]] == static_cast<std::int64_t>(e)) continue;
        Branch b{};
        b.bottom = b.top = static_cast<std::int64_t>(e);
        while (next_above[b.top] >= 0) b.top = next_above[b.top];
        b.highest = result.highest[e];
        b.appears = value_of(arrays, b.top);
        b.merges = root ? -std::numeric_limits<double>::infinity() : value_of(arrays, tree.parent[e]);
        b.hypervolume = hypervolume(e);
        b.height = value_of(arrays, b.highest) - (root ? lowest : b.merges);
        b.voxels = sums.voxels[e];
        branches.push_back(b);
    }
    std::sort(branches.begin() + 1, branches.end(), [](const Branch& p, const Branch& q) {
        return p.hypervolume != q.hypervolume ? p.hypervolume > q.hypervolume : p.top < q.top;
    });
    result.of_event.resize(events);
    for (std::size_t i = 0; i < branches.size(); ++i) {
        for (std::int64_t e = branches[i].bottom; e >= 0; e = next_above[e]) result.of_event[e] = static_cast<std::int64_t>(i);
    }
    return result;
}

template Branches make_branches(const AnalysisArrays<std::uint32_t>&, std::span<const double>, double);
template Branches make_branches(const AnalysisArrays<std::uint64_t>&, std::span<const double>, double);

}  // namespace isoatlas
