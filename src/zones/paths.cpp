#include "zones/paths.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/parallel.h"

namespace isoatlas {
namespace {

/// The largest Value that is not above v.
template <class Value>
Value rounded_down(double v) {
    const auto rounded = static_cast<Value>(v);
    return static_cast<double>(rounded) > v ? std::nextafter(rounded, -std::numeric_limits<Value>::infinity()) : rounded;
}

/// Per event its heaviest child (most events above it; ties: the higher event), the event itself for a leaf. weight: scratch.
template <class Id>
BigVector<Id> heavy_children(const CriticalityTree<Id>& tree, BigVector<Id>& weight) {
    const std::size_t n = tree.size();
    std::fill(weight.begin(), weight.end(), Id{1});
    BigVector<Id> heavy(n);
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

template <class Id, class Value>
HeavyPaths<Id, Value>::HeavyPaths(const CriticalityTree<Id>& tree, std::span<const double> value, std::span<const Id> maxima, int threads)
    : stops_(tree.size()), bucket_(tree.size()), start_(maxima.size()) {
    lay_out(tree, value, maxima, threads);
    for (Id path = 0; path + 1 < paths_.size(); ++path) prepare_scale(path);
    for_each_block(threads, blocks(), [&](std::int64_t b) {
        for (std::size_t path = b * kBlock; path < std::min((b + 1) * kBlock, paths_.size() - 1); ++path)
            make_buckets(static_cast<Id>(path));
    });
}

// One path a leaf event. A leaf event's top element is a maximum, so paths are the maxima that are the top of their event, in raster order.
template <class Id, class Value>
void HeavyPaths<Id, Value>::lay_out(const CriticalityTree<Id>& tree, std::span<const double> value, std::span<const Id> maxima,
                                    int threads) {
    const BigVector<Id> heavy = heavy_children(tree, bucket_);
    paths_.reserve(maxima.size() + 1);
    for (const Id element : maxima) {
        const Id top = tree.event_of_element[element];
        if (tree.top[top] == element && heavy[top] == top) paths_.push_back({0, top, 0});  // its top for now, then its length
    }
    const auto ends_at = [&](Id e) { return tree.is_root(e) || heavy[tree.parent[e]] != e; };
    const auto for_each_path = [&](auto&& work) {
        for_each_block(threads, blocks(), [&](std::int64_t b) {
            for (std::size_t i = b * kBlock; i < std::min((b + 1) * kBlock, paths_.size() - 1); ++i) work(paths_[i], static_cast<Id>(i));
        });
    };
    paths_.push_back({0, 0, 0});
    for_each_path([&](Path& path, Id) {
        for (Id e = path.below;; e = tree.parent[e]) {
            ++path.first;
            if (ends_at(e)) break;
        }
    });
    Id next = 0;
    for (Path& path : paths_) next += std::exchange(path.first, next);
    BigVector<Id>& path_of = bucket_;  // scratch until the buckets are made
    for_each_path([&](Path& path, Id number) {
        Id position = paths_[number + 1].first;
        for (Id e = path.below;; e = tree.parent[e]) {
            path_of[e] = number;
            stops_[--position] = {rounded_down<Value>(value[tree.top[e]]), e};
            if (ends_at(e)) break;
        }
    });
    for_each_path([&](Path& path, Id) {
        const Id bottom = stops_[path.first].event, parent = tree.parent[bottom];
        path.below = path_of[parent];
        path.value_below = tree.is_root(bottom) ? -std::numeric_limits<Value>::infinity() : rounded_down<Value>(value[tree.top[parent]]);
    });
    for (std::size_t m = 0; m < maxima.size(); ++m) start_[m] = path_of[tree.event_of_element[maxima[m]]];
}

template <class Id, class Value>
void HeavyPaths<Id, Value>::prepare_scale(Id path) {
    if (count(path) < kBucketed) return;
    const Id first = paths_[path].first, end = paths_[path + 1].first, buckets = count(path) - 1;
    const double low = stops_[first].value, width = static_cast<double>(stops_[end - 1].value) - low;
    const double factor = static_cast<double>(buckets) / width;
    bucket_[first] = static_cast<Id>(scales_.size());
    scales_.push_back({low, factor < std::numeric_limits<double>::max() ? factor : 0});  // a width that underflows: one bucket
}

template <class Id, class Value>
void HeavyPaths<Id, Value>::make_buckets(Id path) {
    if (count(path) < kBucketed) return;
    const Id first = paths_[path].first, end = paths_[path + 1].first, buckets = count(path) - 1;
    const Scale& scale = scales_[bucket_[first]];
    Id next = 0;
    for (Id p = first; p < end; ++p) {
        const std::size_t last = bucket(scale, buckets, stops_[p].value);
        while (next <= last) bucket_[first + 1 + next++] = p;
    }
    while (next < buckets) bucket_[first + 1 + next++] = end - 1;
}

// Monotone in x, rounding included: that is all the search needs.
template <class Id, class Value>
std::size_t HeavyPaths<Id, Value>::bucket(const Scale& scale, Id buckets, Value x) const {
    const double b = (static_cast<double>(x) - scale.low) * scale.factor;
    return b > 0 ? static_cast<std::size_t>(std::min(b, static_cast<double>(buckets - 1))) : 0;
}

/// Where bucket_ tells a position not above the lowest event of the path with a value of x or more; for a short path that position itself.
template <class Id, class Value>
Id HeavyPaths<Id, Value>::bucket_of(Id path, Value x) const {
    const Id first = paths_[path].first, buckets = count(path) - 1;
    return buckets + 1 < kBucketed ? first : first + 1 + static_cast<Id>(bucket(scales_[bucket_[first]], buckets, x));
}

template <class Id, class Value>
void HeavyPaths<Id, Value>::zones(std::span<const Value> x, std::span<Id> path, std::span<std::uint32_t> scratch,
                                  std::span<Id> zone) const {
    for (Id& p : path) p = start_[p];
    std::size_t climbing = x.size();
    for (std::size_t i = 0; i < climbing; ++i) scratch[i] = static_cast<std::uint32_t>(i);
    while (climbing > 0) {  // one jump for all that still climb
        std::size_t kept = 0;
        for (std::size_t k = 0; k < climbing; ++k) {
            const std::uint32_t i = scratch[k];
            const Path& at = paths_[path[i]];
            const bool jump = at.value_below >= x[i];
            path[i] = jump ? at.below : path[i];
            scratch[kept] = i;
            kept += jump;
        }
        climbing = kept;
    }
    for (std::size_t i = 0; i < x.size(); ++i) {  // zone: first the bucket, then the position where the search starts, then the zone
        zone[i] = bucket_of(path[i], x[i]);
        __builtin_prefetch(bucket_.data() + zone[i]);
    }
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (zone[i] != paths_[path[i]].first) zone[i] = bucket_[zone[i]];
        __builtin_prefetch(stops_.data() + zone[i]);
    }
    for (std::size_t i = 0; i < x.size(); ++i) {
        const Stop* stop = stops_.data() + zone[i];
        for (int step = 0; step < 8 && stop->value < x[i]; ++step) ++stop;
        if (stop->value < x[i]) {  // a crowded bucket
            const Stop* end = stops_.data() + paths_[path[i] + 1].first;
            stop = std::lower_bound(stop, end, x[i], [](const Stop& s, Value value) { return s.value < value; });
        }
        zone[i] = stop->event;
    }
}

template class HeavyPaths<std::uint32_t, float>;
template class HeavyPaths<std::uint32_t, double>;
template class HeavyPaths<std::uint64_t, float>;
template class HeavyPaths<std::uint64_t, double>;

}  // namespace isoatlas
