// Heavy paths of the criticality tree: where does a climb from an event stop?
//
// Every event continues the path of its heaviest child (the one with most events above it); the other children end their paths there. A path
// is an array of events with ascending values, so a climb is a few jumps (at most log2 of the number of events) and one binary search.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

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

    /// The zone of a sample of value x whose ascending path leads to `start`: the event e on the way down from start with
    /// value(parent(e)) < x <= value(e). Requires x <= value(start).
    [[nodiscard]] Id zone(Place start, double x) const {
        const Path* path = &paths_[start.path];
        while (path->value_below >= x) {
            start = path->below;
            path = &paths_[start.path];
        }
        const double* first = values_.data() + path->first;
        const double* found = std::lower_bound(first, values_.data() + start.position, x);
        return events_[static_cast<std::size_t>(found - values_.data())];
    }

private:
    struct Path {
        double value_below;   ///< value of the event the path ends at; -infinity for the path of the root
        Place below;          ///< that event
        Id first;             ///< position of the lowest event of the path
    };
    std::vector<Path> paths_;
    std::vector<double> values_;  ///< by position
    std::vector<Id> events_;      ///< by position
    std::vector<Place> place_;    ///< by event
};

}  // namespace isoatlas
