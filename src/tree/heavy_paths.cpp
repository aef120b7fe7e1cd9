#include "tree/heavy_paths.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "base/memory_limit.h"
#include "base/parallel.h"
#include "base/prefetch.h"
#include "base/streamed.h"

namespace isoatlas {
namespace {

constexpr std::size_t kEventsAhead = 16;  // what lies at random is fetched so many events or maxima before it is needed

/// The largest Value that is not above v.
template <class Value>
Value rounded_down(double v) {
    const auto rounded = static_cast<Value>(v);
    return static_cast<double>(rounded) > v ? std::nextafter(rounded, -std::numeric_limits<Value>::infinity()) : rounded;
}

}  // namespace

// Children come before their parents.
template <class Number>
ByEvent<Number, HeavyNode<Number>> weigh(const DescendingTree<Number>& tree) {
    using Event = EventIdOf<Number>;
    const PinInMemory keep;
    ByEvent<Number, HeavyNode<Number>> nodes(tree.size());
    for (const Event e : streamed<Event>(nodes.size(), in_order(8))) nodes[e] = {e, 1, 1};
    for (const Event e : streamed<Event>(nodes.size(), at_random(2))) {
        if (e.index() + kEventsAhead < nodes.size()) {
            prefetch_to_write(nodes.items().data() + tree.parent[Event(e.index() + kEventsAhead)].index());
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

template <class Number, class Value>
HeavyPathDecomposition<Number, Value>::HeavyPathDecomposition(const DescendingTree<Number>& tree, ByEvent<Number, HeavyNode<Number>> nodes,
                                                              IdSpan<Maximum, const ElementIdOf<Number>> maxima, int threads) {
    const PinInMemory keep;
    BigVector<Path> laid = lay_out(tree, nodes);
    make_stops(tree, nodes, threads);
    for_each_index(threads, laid.size(), [&](std::size_t i) {
        Path& path = laid[i];  // below: so far the event
        const bool is_root = path.below == tree.size();
        path.value_below =
            is_root ? -std::numeric_limits<Value>::infinity() : rounded_down<Value>(tree.value[tree.top_of(Event(path.below))]);
        path.below = is_root ? 0 : nodes[Event(path.below)].path;
    });
    // A leaf event's highest element is a maximum: its number is that of the path.
    BigVector<Maximum> name(laid.size());
    IdArray<Maximum, Number> path_of(maxima.size());
    for_each_index(threads, maxima.size(), [&](std::size_t i) {
        const Maximum m(i);
        if (i + 2 * kEventsAhead < maxima.size()) {
            prefetch(tree.event_of_element.items().data() +
                     (tree.event_of_element.empty() ? 0 : maxima[Maximum(i + 2 * kEventsAhead)].index()));
        }
        if (i + kEventsAhead < maxima.size()) {
            const Event ahead = tree.event_of(maxima[Maximum(i + kEventsAhead)]);
            prefetch(nodes.items().data() + ahead.index());
            if (!tree.top.empty()) prefetch(tree.top.items().data() + ahead.index());
        }
        const Event e = tree.event_of(maxima[m]);
        path_of[m] = nodes[e].path;
        if (nodes[e].heavy == e && tree.top_of(e) == maxima[m]) name[path_of[m]] = m;
    });
    release(nodes.items());  // the next arrays reuse their memory
    make_scales(laid, threads);
    paths_.items().resize(maxima.size());
    for_each_index(threads, maxima.size(), [&](std::size_t i) {
        Path& path = paths_[Maximum(i)];
        path = laid[path_of[Maximum(i)]];
        path.below = name[path.below].number();
    });
}

// Parents before their children: a path begins at its lowest event, and its events are met in ascending order. below: the event that a path
// ends at, of the root's one behind the last.
template <class Number, class Value>
auto HeavyPathDecomposition<Number, Value>::lay_out(const DescendingTree<Number>& tree, IdSpan<Event, HeavyNode<Number>> nodes)
    -> BigVector<Path> {
    BigVector<Path> paths;
    std::size_t leaves = 0;
    for (const Event e : streamed<Event>(tree.size(), in_order(8))) leaves += nodes[e].heavy == e;
    paths.reserve(leaves);  // each path has one
    Number end = 0;
    for (const Event e : streamed_down<Event>(tree.size(), at_random())) {
        if (e.index() >= kEventsAhead) prefetch(nodes.items().data() + tree.parent[Event(e.index() - kEventsAhead)].index());
        const bool is_root = tree.is_root(e);
        const Event parent = is_root ? Event(tree.size()) : tree.parent[e];
        HeavyNode<Number>& node = nodes[e];
        if (!is_root && nodes[parent].heavy == e) {
            node.path = nodes[parent].path;
            node.position = nodes[parent].position + 1;
        } else {
            const Number first = std::exchange(end, end + node.position);
            paths.push_back({0, parent.number(), first, end});
            node.path = static_cast<Number>(paths.size() - 1);
            node.position = first;
        }
    }
    return paths;
}

template <class Number, class Value>
void HeavyPathDecomposition<Number, Value>::make_stops(const DescendingTree<Number>& tree, IdSpan<Event, const HeavyNode<Number>> nodes,
                                                       int threads) {
    stops_.resize(tree.size() + kSteps);
    std::fill(stops_.end() - kSteps, stops_.end(), Stop{0, Event(0)});
    for_each_index(threads, tree.size(), [&](std::size_t i) {
        const Event e(i);
        stops_[nodes[e].position] = {rounded_down<Value>(tree.value[tree.top_of(e)]), e};
    });
}

template <class Number, class Value>
void HeavyPathDecomposition<Number, Value>::make_scales(std::span<Path> paths, int threads) {
    scales_.push_back({0, 0, 0, 0});
    for (const std::size_t i : streamed(paths.size(), in_order(2))) {
        const Number end = paths[i].scale;
        const bool is_long = end - paths[i].first >= kBucketed;
        paths[i].scale = is_long ? static_cast<Number>(scales_.size()) : 0;
        if (is_long) scales_.push_back({0, 0, 0, end});
    }
    bucket_.resize(stops_.size() - kSteps);
    for_each_index(threads, paths.size(), [&](std::size_t i) { make_buckets(paths[i]); });
}

template <class Number, class Value>
void HeavyPathDecomposition<Number, Value>::make_buckets(const Path& path) {
    if (path.scale == 0) {
        bucket_[path.first] = path.first;
        return;
    }
    Scale& scale = scales_[path.scale];
    const Number count = scale.end - path.first;
    scale.low = stops_[path.first].value, scale.last = static_cast<double>(count - 1);
    const double factor = scale.last / (static_cast<double>(stops_[scale.end - 1].value) - scale.low);
    scale.factor = factor < std::numeric_limits<double>::max() ? factor : 0;  // a width that underflows: one bucket
    Number* const first_in = bucket_.data() + path.first;
    Number next = 0;
    for (const std::size_t position : streamed(count, in_order(8))) {
        const Number p = path.first + static_cast<Number>(position);
        const Number last = bucket_of(path, stops_[p].value) - path.first;
        while (next <= last) first_in[next++] = p;
    }
    while (next < count) first_in[next++] = scale.end - 1;
}

/// Where bucket_ holds a position not above the lowest event of the path with a value of x or more. Monotone in x, rounding included: that
/// is all the search needs.
template <class Number, class Value>
[[gnu::always_inline]] inline Number HeavyPathDecomposition<Number, Value>::bucket_of(const Path& path, Value x) const {
    const Scale& scale = scales_[path.scale];
    const double bucket = (static_cast<double>(x) - scale.low) * scale.factor;
    return path.first + static_cast<Number>(std::min(std::max(bucket, 0.0), scale.last));
}

template <class Number, class Value>
Number HeavyPathDecomposition<Number, Value>::end_of_bucket(const Path& path, Value x) const {
    const Number bucket = bucket_of(path, x), end = scales_[path.scale].end;
    return bucket + 1 < end ? bucket_[bucket + 1] + 1 : end;
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
    for (int k = 0; on && k < kMoreSteps && stop->value < x; ++k) ++stop;
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
    for (const std::size_t k : streamed(order.size(), at_random())) {
        const std::uint32_t i = order[k];
        zone[i] = bucket_of(paths_[Maximum(path[i])], x[i]);
    }
    sort_by(order, zone);  // positions in a path are in about the same order
    for (const std::size_t k : streamed(order.size(), at_random(3))) {
        const std::uint32_t i = order[k];
        zone[i] = event_from(bucket_[zone[i]], path[i], x[i]).number();
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
        prefetch(bucket_.data() + zone[i]);
    }
    for (std::size_t i = 0; i < x.size(); ++i) {
        zone[i] = bucket_[zone[i]];
        prefetch(stops_.data() + zone[i]);
        prefetch(stops_.data() + zone[i] + kSteps - 1);
    }
    for (std::size_t i = 0; i < x.size(); ++i) zone[i] = event_from(zone[i], path[i], x[i]).number();
}

template ByEvent<std::uint32_t, HeavyNode<std::uint32_t>> weigh(const DescendingTree<std::uint32_t>&);
template ByEvent<std::uint64_t, HeavyNode<std::uint64_t>> weigh(const DescendingTree<std::uint64_t>&);
template class HeavyPathDecomposition<std::uint32_t, float>;
template class HeavyPathDecomposition<std::uint32_t, double>;
template class HeavyPathDecomposition<std::uint64_t, float>;
template class HeavyPathDecomposition<std::uint64_t, double>;

}  // namespace isoatlas
