// Heavy paths of the criticality tree: where does a climb from an event stop?
//
// Every event continues the path of its heaviest child (the one with most events above it); the other children end their paths there. A path
// is an array of events with ascending values, so a climb is a few jumps (at most log2 of the number of events) and one search in an array.
// A long path has as many buckets of equal width as events: the search looks at one bucket.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/big_vector.h"
#include "tree/criticality_tree.h"

namespace isoatlas {

template <class Id>
class HeavyPaths {
public:
    /// A place on a path. Positions count through all paths; a path runs upwards in value.
    struct Place {
        Id path, position;
    };

    /// value: per element (tree.top gives the element of an event).
    HeavyPaths(const CriticalityTree<Id>& tree, std::span<const double> value);

    [[nodiscard]] Place place(std::size_t event) const { return place_[event]; }
    /// Gives back the memory of place().
    void forget_places() { release(place_); }

    /// Zones of many samples at once: for sample i of value x[i] whose ascending path leads to place[i], the event e on the way down from
    /// there with value(parent(e)) < x <= value(e). Requires x[i] <= value(place[i]). place is scratch. In rounds over all samples, so that
    /// their memory accesses overlap. scratch: as many entries as samples.
    void zones(std::span<const double> x, std::span<Place> place, std::span<std::uint32_t> scratch, std::span<Id> zone) const;

private:
    struct Path {
        double value_below;   ///< value of the event the path ends at; -infinity for the path of the root
        Place below;          ///< that event
        Id first, count;      ///< positions of its events
        Id scale;             ///< place in scales_ of a long path
    };
    struct Scale {
        double low, factor;   ///< bucket of x = (x - low) * factor
    };
    static constexpr std::size_t kBucketed = 16;  ///< shorter paths are searched directly

    void make_buckets(Path& path);
    [[nodiscard]] std::size_t bucket(const Path& path, double x) const;

    BigVector<Path> paths_;
    std::vector<Scale> scales_;
    BigVector<double> value_;     ///< by position
    BigVector<Id> event_;         ///< by position
    BigVector<Id> bucket_;        ///< by path.first + bucket: the first position of the path in this bucket or a later one
    BigVector<Place> place_;      ///< by event
};

}  // namespace isoatlas
