// Heavy path decomposition of a tree whose values descend towards the root, for weighted level ancestor queries: the last event on the way
// to the root with a value of at least x. The tree is the criticality tree, or a join tree, where every element is an event.
//
// Every event continues the path of its heaviest child (the one with most events above it); the other children end their paths there. A
// path is an array of events with ascending values, so a query is a few jumps (at most log2 of the number of events) and one search in an
// array. A long path has nearly as many buckets of equal width as events: the search reads one bucket.
//
// All arrays are compact, because the cost of a query is a handful of cache misses; a path is numbered by a maximum that leads to it, so
// that neighbours in the volume find their paths side by side. Value: the type in which samples are compared with events. float serves
// samples that are floats or integers of 16 bits: x <= v iff x <= v rounded down to float, for every float x.
//
// In the literature: heavy path decomposition (Sleator, Tarjan, A data structure for dynamic trees, 1983); weighted level ancestor queries.
#pragma once

#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "base/big_vector.h"
#include "critical/ids.h"

namespace isoatlas {

/// The type in which samples of T are compared with events.
template <class T>
using ComparisonValue = std::conditional_t<std::is_same_v<T, float> || sizeof(T) <= 2, float, double>;

/// A tree and its elements; the last two are empty where every element is an event.
template <class Number>
struct DescendingTree {
    using Element = ElementIdOf<Number>;
    using Event = EventIdOf<Number>;
    ByEventView<Number, Event> parent;  ///< comes later; of a root: itself, or one behind the last
    ByElementView<Number, double> value;
    ByEventView<Number, Element> top;  ///< its highest element
    ByElementView<Number, Event> event_of_element;

    /// Of a join tree: every element is an event. parent: without that of the outside.
    [[nodiscard]] static DescendingTree of_elements(ByElementView<Number, Element> parent, ByElementView<Number, double> value) {
        return {ByEventView<Number, Event>(ids_of<Event>(numbers_of(parent.items()))), value, {}, {}};
    }

    [[nodiscard]] std::size_t size() const { return parent.size(); }
    [[nodiscard]] bool is_root(Event e) const { return parent[e] == e || parent[e] == Event(size()); }
    [[nodiscard]] Element top_of(Event e) const { return top.empty() ? Element(e.number()) : top[e]; }
    [[nodiscard]] Event event_of(Element element) const {
        return event_of_element.empty() ? Event(element.number()) : event_of_element[element];
    }
};

/// An event while the paths are laid out.
template <class Number>
struct HeavyNode {
    EventIdOf<Number> heavy;  ///< heaviest child (most events above it; ties: the higher event), the event itself for a leaf
    Number path;              ///< first the weight: events above it and itself
    Number position;          ///< in stops_; first the length of its path from here up
};

/// Weights, heavy children, lengths. Cost: O(n), one parent at random an event.
template <class Number>
[[nodiscard]] ByEvent<Number, HeavyNode<Number>> weigh(const DescendingTree<Number>& tree);

template <class Number, class Value>
class HeavyPathDecomposition {
public:
    using Event = EventIdOf<Number>;
    using Maximum = MaximumIdOf<Number>;

    /// maxima: per maximum, in raster order, its element. Cost: O(n) time; 12 bytes an event besides the result while it runs.
    HeavyPathDecomposition(const DescendingTree<Number>& tree, IdSpan<Maximum, const ElementIdOf<Number>> maxima, int threads)
        : HeavyPathDecomposition(tree, weigh(tree), maxima, threads) {}
    /// nodes: of weigh().
    HeavyPathDecomposition(const DescendingTree<Number>& tree, ByEvent<Number, HeavyNode<Number>> nodes,
                           IdSpan<Maximum, const ElementIdOf<Number>> maxima, int threads);

    /// Zones of many samples at once: for sample i of value x[i] whose ascending path leads to maximum[i]: the event e on the way down with
    /// value(parent(e)) < x[i] <= value(e). In rounds over all samples, so that their cache misses overlap.
    /// maximum, zone: numbers of maxima and events, as the memory of basins becomes that of zones. maximum (at last: that of the path where
    /// the climb stopped) and scratch are overwritten; all spans have one entry a sample.
    void zones(std::span<const Value> x, std::span<Number> maximum, std::span<std::uint32_t> scratch, std::span<Number> zone) const;

private:
    struct Path {
        Value value_below;  ///< value of the event the path ends at; -infinity for the path of the root
        Number below;       ///< path of that event
        Number first;       ///< position of its lowest event in stops_
        Number scale;       ///< place in scales_; first the position behind its highest event
    };
    struct Stop {
        Value value;
        Event event;
    };
    struct Scale {
        double low, factor, last;  ///< bucket of x = (x - low) * factor, at most last
        Number end;                ///< position behind the highest event of the path
    };
    static constexpr int kSteps = 4;      ///< of a search that are taken without branches; stops_ has as many more entries
    static constexpr int kMoreSteps = 8;  ///< with branches; then the search is binary
    static constexpr Number kBucketed = kSteps + kMoreSteps + 1;  ///< shorter paths are searched by steps: they have one scale, of 0

    [[nodiscard]] BigVector<Path> lay_out(const DescendingTree<Number>& tree, IdSpan<Event, HeavyNode<Number>> nodes);
    void make_stops(const DescendingTree<Number>& tree, IdSpan<Event, const HeavyNode<Number>> nodes, int threads);
    void make_scales(std::span<Path> paths, int threads);
    void make_buckets(const Path& path);
    [[nodiscard]] Number bucket_of(const Path& path, Value x) const;
    [[nodiscard]] Event event_from(Number position, Number path, Value x) const;
    void zones_by_place(std::span<const Value> x, std::span<Number> path, std::span<std::uint32_t> order, std::span<Number> zone) const;
    /// Behind the position of the lowest event with a value of x or more.
    [[nodiscard]] Number end_of_bucket(const Path& path, Value x) const;

    IdArray<Maximum, Path> paths_;  ///< maxima of one event have equal ones
    BigVector<Stop> stops_;         ///< by position
    BigVector<Number> bucket_;      ///< by position; of a long path: per bucket the first position in it or a later one; of others: first
    std::vector<Scale> scales_;     ///< the first is that of short paths
};

}  // namespace isoatlas
