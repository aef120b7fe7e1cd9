// The active zones and contours at an isovalue, in the numbering of the trees.
//
// Elements and events are sorted by value: an isovalue is a rank, the number of those at or above it. A zone is the interval of ranks
// between its event and the parent, a contour the one between the ends of its arc. Which of them contain a rank is read off the arrays of
// the trees (base/max_pyramid.h); the object of a contour is an ancestor of the event at its upper end, its low component one of its lower
// end (T6).
//
// In the literature: stabbing queries; for cells usually answered by an interval tree (Cignoni et al., Speeding up isosurface extraction
// using interval trees, 1997).
#pragma once

#include <cmath>

#include "analysis/analysis_data.h"
#include "base/max_pyramid.h"
#include "tree/level_ancestor.h"
#include "tree/split_tree.h"

namespace isoatlas {

/// Data for queries of contours: 13 bytes an element (ids of 32 bits).
template <class Id>
struct ActiveContours {
    MaxPyramid<Id, std::greater<>> highest_other;
    MaxPyramid<Id, std::less<>> lowest_other;
    SplitTree<Id> low;
    LevelAncestor<Id> climber;  ///< of low.parent

    explicit ActiveContours(const ContourTree<Id>& contours)
        : highest_other(contours.other), lowest_other(contours.other), low(split_tree_of(contours)), climber(low.parent) {}
};

template <class Id>
class ActiveZones {
public:
    /// The arrays must live as long as this.
    explicit ActiveZones(const AnalysisArrays<Id>& arrays);

    [[nodiscard]] std::size_t events() const { return arrays_.tree.size(); }
    [[nodiscard]] double value(std::size_t event) const { return arrays_.value[arrays_.tree.top[event]]; }
    [[nodiscard]] bool counts_voxels() const { return !arrays_.voxels.empty(); }
    /// Of the object at the low end of the zone of an event.
    [[nodiscard]] std::int64_t object_voxels(std::size_t event) const { return static_cast<std::int64_t>(object_voxels_[event]); }
    /// The child with most voxels; the event itself when there is none.
    [[nodiscard]] std::size_t largest_child(std::size_t event) const { return largest_child_[event]; }
    /// Event of the highest element of the object.
    [[nodiscard]] std::size_t highest(std::size_t event) const { return highest_[event]; }

    /// Number of events with a value of at least (above: of more than) tau.
    [[nodiscard]] std::size_t rank(double tau, bool above = false) const;
    /// The events whose zones contain the rank, ascending.
    [[nodiscard]] std::vector<Id> zones(std::size_t rank) const;
    /// The zone of a lower rank that contains the object of an event.
    [[nodiscard]] Id zone_at(Id event, std::size_t rank) const {
        return climber_.climb(event, [rank](Id e) { return e < rank; });
    }
    /// Number of elements with a value of at least (above: of more than) tau.
    [[nodiscard]] std::size_t element_rank(double tau, bool above = false) const;
    /// Calls visit(arc) for the arcs of the contour tree that contain the rank (of elements).
    template <class Visit>
    void for_contours(std::size_t rank, Visit&& visit) const {
        if (rank == 0) return;
        const auto limit = static_cast<Id>(rank);
        contours().highest_other.for_each_at_least(0, rank, limit, visit);
        contours().lowest_other.for_each_at_least(rank, arrays_.contours.nodes(), limit - 1, visit);
    }
    /// Of an arc that contains the rank: is its contour an outer one, and the lowest element of its low component.
    [[nodiscard]] bool is_outer(std::size_t arc) const { return arrays_.contours.other[arc] > static_cast<Id>(arc); }
    [[nodiscard]] Id lowest(std::size_t arc, std::size_t rank) const { return lowest_with(arrays_.contours.lower(arc), rank); }
    /// The lowest element of the low component that holds a Low element.
    [[nodiscard]] Id lowest_with(Id element, std::size_t rank) const {
        return contours().low.lowest[contours().climber.climb(element, [rank](Id x) { return x >= rank; })];
    }
    [[nodiscard]] const AnalysisArrays<Id>& arrays() const { return arrays_; }

private:
    [[nodiscard]] const ActiveContours<Id>& contours() const {
        return *contours_.get([this] { return std::make_unique<ActiveContours<Id>>(arrays_.contours); });
    }

    const AnalysisArrays<Id>& arrays_;
    MaxPyramid<Id, std::greater<>> parents_;
    LevelAncestor<Id> climber_;
    BigVector<Id> highest_, largest_child_, object_voxels_;
    Lazy<std::unique_ptr<ActiveContours<Id>>> contours_;
};

}  // namespace isoatlas
