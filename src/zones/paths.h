// Heavy paths of the criticality tree: where does a climb from an event stop?
//
// Every event continues the path of its heaviest child (the one with most events above it); the other children end their paths there. A
// path is an array of events with ascending values, so a climb is a few jumps (at most log2 of the number of events) and one search in an
// array. A long path has nearly as many buckets of equal width as events: the search looks at one bucket.
//
// Everything is made small and lies in the raster order of maxima, because a climb is a handful of cache misses and nothing else. Value:
// the type in which samples are compared with events. float serves samples that are floats or integers of 16 bits: x <= v iff x <= v
// rounded down to float, for every float x.
#pragma once

#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "base/big_vector.h"
#include "tree/criticality_tree.h"

namespace isoatlas {

/// The type in which samples of T are compared with events.
template <class T>
using ComparisonValue = std::conditional_t<std::is_same_v<T, float> || sizeof(T) <= 2, float, double>;

template <class Id, class Value>
class HeavyPaths {
public:
    /// value: per element (tree.top gives the element of an event). maxima: per maximum, in raster order, its element.
    HeavyPaths(const CriticalityTree<Id>& tree, std::span<const double> value, std::span<const Id> maxima, int threads);

    /// Zones of many samples at once: for sample i of value x[i] whose ascending path leads to maximum[i]: the event e on the way down with
    /// value(parent(e)) < x[i] <= value(e). In rounds over all samples, so that their cache misses overlap.
    /// maximum and scratch are overwritten; all spans have one entry a sample.
    void zones(std::span<const Value> x, std::span<Id> maximum, std::span<std::uint32_t> scratch, std::span<Id> zone) const;

private:
    struct Path {
        Value value_below;  ///< value of the event the path ends at; -infinity for the path of the root
        Id below;           ///< path of that event
        Id first;           ///< position of the lowest event; the path goes on to the first of the next one
    };
    struct Stop {
        Value value;
        Id event;
    };
    struct Scale {
        double low, factor;  ///< bucket of x = (x - low) * factor
    };
    static constexpr Id kBucketed = 16;             ///< shorter paths are searched directly
    static constexpr std::size_t kBlock = 1 << 14;  ///< paths that are laid out as one unit of work

    void lay_out(const CriticalityTree<Id>& tree, std::span<const double> value, std::span<const Id> maxima, int threads);
    void prepare_scale(Id path);
    void make_buckets(Id path);
    [[nodiscard]] std::int64_t blocks() const { return static_cast<std::int64_t>((paths_.size() + kBlock - 1) / kBlock); }
    [[nodiscard]] Id count(Id path) const { return paths_[path + 1].first - paths_[path].first; }
    [[nodiscard]] std::size_t bucket(const Scale& scale, Id buckets, Value x) const;
    [[nodiscard]] Id bucket_of(Id path, Value x) const;

    BigVector<Path> paths_;  ///< and one more, where the last one ends
    BigVector<Stop> stops_;  ///< by position
    BigVector<Id> bucket_;   ///< of a long path: its place in scales_, then per bucket the first position in it or a later one
    std::vector<Scale> scales_;
    BigVector<Id> start_;  ///< per maximum: the path of its event
};

}  // namespace isoatlas
