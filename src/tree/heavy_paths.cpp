#include "tree/heavy_paths.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "base/memory_limit.h"
#include "base/parallel.h"
#include "base/streamed.h"

namespace isoatlas {
namespace {

constexpr std::size_t kEventsAhead = 16;  // a parent is fetched so many events before it is needed

/// The largest Value that is not above v.
template <class Value>
Value rounded_down(double v) {
    const auto rounded = static_cast<Value>(v);
    return static_cast<double>(rounded) > v ? std::nextafter(rounded, -std::numeric_limits<Value>::infinity()) : rounded;
}

/// Weights, heavy children, lengths. Children come before their parents.
template <class Number>
ByEvent<Number, HeavyNode<Number>> weigh(const DescendingTree<Number>& tree) {
    using Event = EventIdOf<Number>;
    ByEvent<Number, HeavyNode<Number>> nodes(tree.size());
    for (const Event e : streamed<Event>(nodes.size(), in_order(8))) nodes[e] = {e, 1, 1};
    for (const Event e : streamed<Event>(nodes.size(), at_random(2))) {
        if (e.index() + kEventsAhead < nodes.size()) {
            __builtin_prefetch(nodes.items().data() + tree.parent[Event(e.index() + kEventsAhead)].index(), 1);
        }
        if (tree.is_root(e)) continue;
        const Event p = tree.parent[e];
        nodes[p].path += nodes[e].path;
        if (nodes[p].heavy != p && nodes[e].path <= nodes[nodes[p].heavy].path) continue;
        nodes[p].heavy = e;
        nodes[p].position = nodes[e].position + 1;
    }
    return nodes;
}

}  // namespace

template <class Number, class Value>
HeavyPathDecomposition<Number, Value>::HeavyPathDecomposition(const DescendingTree<Number>& tree,
                                                              IdSpan<Maximum, const ElementIdOf<Number>> maxima, int threads) {
    const PinInMemory keep;
    stops_.resize(tree.size() + kSteps);
    std::fill(stops_.end() - kSteps, stops_.end(), Stop{0, Event(0)});
    ByEvent<Number, HeavyNode<Number>> nodes = weigh(tree);
    const BigVector<Path> laid = lay_out(tree, nodes);
    // A leaf event's highest element is a maximum: its number is that of the path.
    BigVector<Maximum> name(laid.size());
    IdArray<Maximum, Number> path_of(maxima.size());
    for_each_index(threads, maxima.size(), [&](std::size_t i) {
        const Maximum m(i);
        const Event e = tree.event_of(maxima[m]);
        path_of[m] = nodes[e].path;
        if (nodes[e].heavy == e && tree.top_of(e) == maxima[m]) name[path_of[m]] = m;
    });
    release(nodes.items());  // the next arrays reuse their memory
    bucket_.resize(tree.size());
    paths_.items().resize(maxima.size());
    for_each_index(threads, maxima.size(), [&](std::size_t i) {
        Path& path = paths_[Maximum(i)];
        path = laid[path_of[Maximum(i)]];
        path.below = name[path.below].number();
    });
    for (const std::size_t path : streamed(laid.size(), at_random(2))) prepare_scale(laid[path]);
    for_each_index(threads, laid.size(), [&](std::size_t path) { make_buckets(laid[path]); });
}

// Parents before their children: a path begins at its lowest event, and its events are met in ascending order.
template <class Number, class Value>
auto HeavyPathDecomposition<Number, Value>::lay_out(const DescendingTree<Number>& tree, IdSpan<Event, HeavyNode<Number>> nodes)
    -> BigVector<Path> {
    BigVector<Path> paths;
    std::size_t leaves = 0;
    for (const Event e : streamed<Event>(tree.size(), in_order(8))) leaves += nodes[e].heavy == e;
    paths.reserve(leaves);  // each path has one
    Number end = 0;
    for (const Event e : streamed_down<Event>(tree.size(), at_random(3))) {
        if (e.index() >= kEventsAhead) __builtin_prefetch(nodes.items().data() + tree.parent[Event(e.index() - kEventsAhead)].index());
        const bool is_root = tree.is_root(e);
        HeavyNode<Number>& node = nodes[e];
        const HeavyNode<Number>& parent = nodes[is_root ? e : tree.parent[e]];
        if (!is_root && parent.heavy == e) {
            node.path = parent.path;
            node.position = parent.position + 1;
        } else {
            const Number first = std::exchange(end, end + node.position);
            paths.push_back(is_root ? Path{-std::numeric_limits<Value>::infinity(), 0, first, end}
                                    : Path{stops_[parent.position].value, parent.path, first, end});
            node.path = static_cast<Number>(paths.size() - 1);
            node.position = first;
        }
        stops_[node.position] = {rounded_down<Value>(tree.value[tree.top_of(e)]), e};
    }
    return paths;
}

template <class Number, class Value>
void HeavyPathDecomposition<Number, Value>::prepare_scale(const Path& path) {
    if (!is_long(path)) return;
    const double low = stops_[path.first].value, width = static_cast<double>(stops_[path.end - 1].value) - low;
    const double factor = static_cast<double>(buckets(path)) / width;
    bucket_[path.first] = static_cast<Number>(scales_.size());
    scales_.push_back({low, factor < std::numeric_limits<double>::max() ? factor : 0});  // a width that underflows: one bucket
}

template <class Number, class Value>
void HeavyPathDecomposition<Number, Value>::make_buckets(const Path& path) {
    if (!is_long(path)) return;
    Number* const first_in = bucket_.data() + path.first + 1;
    Number next = 0;
    for (const std::size_t position : streamed(path.end - path.first, in_order(8))) {
        const Number p = path.first + static_cast<Number>(position);
        const Number last = bucket_of(path, stops_[p].value) - path.first - 1;
        while (next <= last) first_in[next++] = p;
    }
    while (next < buckets(path)) first_in[next++] = path.end - 1;
}

/// Where bucket_ holds a position not above the lowest event of the path with a value of x or more; for a short path that position itself.
/// Monotone in x, rounding included: that is all the search needs.
template <class Number, class Value>
Number HeavyPathDecomposition<Number, Value>::bucket_of(const Path& path, Value x) const {
    if (!is_long(path)) return path.first;
    const Scale& scale = scales_[bucket_[path.first]];
    const double bucket = (static_cast<double>(x) - scale.low) * scale.factor;
    return path.first + 1 + (bucket > 0 ? static_cast<Number>(std::min(bucket, static_cast<double>(buckets(path) - 1))) : Number{0});
}

template <class Number, class Value>
Number HeavyPathDecomposition<Number, Value>::end_of_bucket(const Path& path, Value x) const {
    const Number bucket = bucket_of(path, x);
    return is_long(path) && bucket < path.first + buckets(path) ? bucket_[bucket + 1] + 1 : path.end;
}

/// From a position not above it: the lowest event of the path with a value of x or more.
template <class Number, class Value>
[[gnu::always_inline]] inline EventIdOf<Number> HeavyPathDecomposition<Number, Value>::event_from(Number position, Number path,
                                                                                                  Value x) const {
    const Stop* stop = stops_.data() + position;
    // The first steps are branch-free, as branches would be unpredictable. Once a stop is high enough it stays the result.
    bool on = true;
    std::size_t steps = 0;
    for (int k = 0; k < kSteps; ++k) {
        on = on & (stop[k].value < x);
        steps += on;
    }
    stop += steps;
    for (int k = 0; on && k < 8 && stop->value < x; ++k) ++stop;
    if (on && stop->value < x) {  // a crowded bucket
        const Stop* end = stops_.data() + end_of_bucket(paths_[Maximum(path)], x);
        stop = std::lower_bound(stop, end, x, [](const Stop& s, Value value) { return s.value < value; });
    }
    return stop->event;
}

/// Where the arrays lie in the scratch file every access may bring pages of it: samples are taken in the order of what they access.
template <class Number, class Value>
void HeavyPathDecomposition<Number, Value>::zones_by_place(std::span<const Value> x, std::span<Number> path, std::span<std::uint32_t> order,
                                                           std::span<Number> zone) const {
    const auto sort_by = [](std::span<std::uint32_t> some, std::span<const Number> place) {
        std::ranges::sort(some, {}, [place](std::uint32_t i) { return place[i]; });
    };
    std::iota(order.begin(), order.end(), 0U);
    for (std::size_t climbing = order.size(), kept = 0; climbing > 0; climbing = std::exchange(kept, 0)) {
        sort_by(order.first(climbing), path);
        for (const std::size_t k : streamed(climbing, at_random())) {
            const std::uint32_t i = order[k];
            const Path& at = paths_[Maximum(path[i])];
            if (at.value_below < x[i]) continue;
            path[i] = at.below;
            order[kept++] = i;
        }
    }
    std::iota(order.begin(), order.end(), 0U);
    sort_by(order, path);
    std::vector<std::uint8_t> in_bucket(x.size());
    for (const std::size_t k : streamed(order.size(), at_random())) {
        const std::uint32_t i = order[k];
        const Path& at = paths_[Maximum(path[i])];
        zone[i] = bucket_of(at, x[i]);
        in_bucket[i] = zone[i] != at.first;
    }
    sort_by(order, zone);  // positions in a path are in about the same order
    for (const std::size_t k : streamed(order.size(), at_random(3))) {
        const std::uint32_t i = order[k];
        zone[i] = event_from(in_bucket[i] != 0 ? bucket_[zone[i]] : zone[i], path[i], x[i]).number();
    }
}

template <class Number, class Value>
void HeavyPathDecomposition<Number, Value>::zones(std::span<const Value> x, std::span<Number> path, std::span<std::uint32_t> scratch,
                                                  std::span<Number> zone) const {
    if (is_scratch(paths_.items().data()) || is_scratch(stops_.data())) return zones_by_place(x, path, scratch.first(x.size()), zone);
    std::size_t climbing = x.size();
    for (std::size_t i = 0; i < climbing; ++i) scratch[i] = static_cast<std::uint32_t>(i);
    while (climbing > 0) {  // one jump for all that still climb
        std::size_t kept = 0;
        for (std::size_t k = 0; k < climbing; ++k) {
            const std::uint32_t i = scratch[k];
            const Path& at = paths_[Maximum(path[i])];
            const bool jump = at.value_below >= x[i];
            path[i] = jump ? at.below : path[i];
            scratch[kept] = i;
            kept += jump;
        }
        climbing = kept;
    }
    for (std::size_t i = 0; i < x.size(); ++i) {  // zone: first the bucket, then the position where the search starts, then the zone
        zone[i] = bucket_of(paths_[Maximum(path[i])], x[i]);
        __builtin_prefetch(bucket_.data() + zone[i]);
    }
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (zone[i] != paths_[Maximum(path[i])].first) zone[i] = bucket_[zone[i]];
        __builtin_prefetch(stops_.data() + zone[i]);
        __builtin_prefetch(stops_.data() + zone[i] + kSteps - 1);
    }
    for (std::size_t i = 0; i < x.size(); ++i) zone[i] = event_from(zone[i], path[i], x[i]).number();
}

template class HeavyPathDecomposition<std::uint32_t, float>;
template class HeavyPathDecomposition<std::uint32_t, double>;
template class HeavyPathDecomposition<std::uint64_t, float>;
template class HeavyPathDecomposition<std::uint64_t, double>;

}  // namespace isoatlas
