#include "zones/paths.h"

#include <algorithm>
#include <limits>

namespace isoatlas {
namespace {

/// Per event its heaviest child (most events above it; ties: the higher event), the event itself for a leaf.
template <class Id>
BigVector<Id> heavy_children(const CriticalityTree<Id>& tree) {
    const std::size_t n = tree.size();
    BigVector<Id> weight(n, Id{1}), heavy(n);
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
    : value_(tree.size()), event_(tree.size()), place_(tree.size()) {
    const BigVector<Id> heavy = heavy_children(tree);
    Id position = 0;
    for (std::size_t bottom = tree.size(); bottom-- > 0;) {  // parents before children: the place below is known
        const std::size_t parent = tree.parent[bottom];
        const bool root = tree.is_root(bottom);
        if (!root && heavy[parent] == static_cast<Id>(bottom)) continue;
        Path path{};
        path.value_below = root ? -std::numeric_limits<double>::infinity() : value[tree.top[parent]];
        if (!root) path.below = place_[parent];
        path.first = position;
        for (std::size_t e = bottom;; e = heavy[e]) {
            place_[e] = {static_cast<Id>(paths_.size()), position};
            event_[position] = static_cast<Id>(e);
            value_[position++] = value[tree.top[e]];
            if (heavy[e] == static_cast<Id>(e)) break;
        }
        path.count = position - path.first;
        paths_.push_back(path);
    }
    bucket_.resize(tree.size());
    for (Path& path : paths_) make_buckets(path);
}

template <class Id>
void HeavyPaths<Id>::make_buckets(Path& path) {
    if (path.count < kBucketed) return;
    const double low = value_[path.first], width = value_[path.first + path.count - 1] - low;
    double factor = static_cast<double>(path.count) / width;
    if (!(factor < std::numeric_limits<double>::max())) factor = 0;  // a width that underflows: one bucket
    path.scale = static_cast<Id>(scales_.size());
    scales_.push_back({low, factor});
    Id next = path.first;
    for (Id p = path.first; p < path.first + path.count; ++p) {
        const Id last = path.first + static_cast<Id>(bucket(path, value_[p]));
        while (next <= last) bucket_[next++] = p;
    }
    while (next < path.first + path.count) bucket_[next++] = path.first + path.count - 1;
}

template <class Id>
std::size_t HeavyPaths<Id>::bucket(const Path& path, double x) const {
    const Scale& scale = scales_[path.scale];
    const double b = (x - scale.low) * scale.factor;  // monotone in x, rounding included: that is all the search needs
    return b > 0 ? static_cast<std::size_t>(std::min(b, static_cast<double>(path.count - 1))) : 0;
}

template <class Id>
void HeavyPaths<Id>::zones(std::span<const double> x, std::span<Place> place, std::span<std::uint32_t> scratch, std::span<Id> zone) const {
    std::size_t climbing = x.size();
    for (std::size_t i = 0; i < climbing; ++i) scratch[i] = static_cast<std::uint32_t>(i);
    while (climbing > 0) {  // one jump for all that still climb
        std::size_t kept = 0;
        for (std::size_t k = 0; k < climbing; ++k) {
            const std::uint32_t i = scratch[k];
            const Path& path = paths_[place[i].path];
            const bool jump = path.value_below >= x[i];
            place[i] = jump ? path.below : place[i];
            scratch[kept] = i;
            kept += jump;
        }
        climbing = kept;
    }
    for (std::size_t i = 0; i < x.size(); ++i) {  // zone[i]: where the search starts
        const Path& path = paths_[place[i].path];
        zone[i] = path.count < kBucketed ? path.first : bucket_[path.first + bucket(path, x[i])];
        scratch[i] = static_cast<std::uint32_t>(std::min<Id>(place[i].position - std::min(zone[i], place[i].position), 8));
    }
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double* stop = value_.data() + zone[i];
        const double* end = value_.data() + place[i].position;
        for (std::uint32_t step = scratch[i]; step > 0 && *stop < x[i]; --step) ++stop;
        if (*stop < x[i]) stop = std::lower_bound(stop, end, x[i]);
        zone[i] = event_[static_cast<std::size_t>(stop - value_.data())];
    }
}

template class HeavyPaths<std::uint32_t>;
template class HeavyPaths<std::uint64_t>;

}  // namespace isoatlas
