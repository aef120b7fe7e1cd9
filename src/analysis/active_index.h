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
template <class Number>
struct ActiveContours {
    using Element = ElementIdOf<Number>;
    MaxPyramid<Element, std::greater<>> highest_other;
    MaxPyramid<Element, std::less<>> lowest_other;
    SplitTree<Number> low;
    LevelAncestor<Element> climber;  ///< of low.parent

    explicit ActiveContours(const ContourTree<Number>& contours)
        : highest_other(contours.other.items()), lowest_other(contours.other.items()), low(split_tree_of(contours)), climber(low.parent) {}
};

template <class Number>
class ActiveZones {
public:
    using Element = ElementIdOf<Number>;
    using Event = EventIdOf<Number>;

    /// The arrays must live as long as this.
    explicit ActiveZones(const AnalysisArrays<Number>& arrays);

    [[nodiscard]] std::size_t events() const { return arrays_.tree.size(); }
    [[nodiscard]] double value(Event event) const { return arrays_.value[arrays_.tree.top[event]]; }
    [[nodiscard]] bool counts_voxels() const { return !arrays_.voxels.empty(); }
    /// Of the object at the low end of the zone of an event.
    [[nodiscard]] std::int64_t object_voxels(Event event) const { return static_cast<std::int64_t>(object_voxels_[event]); }
    /// The child with most voxels; the event itself when there is none.
    [[nodiscard]] Event largest_child(Event event) const { return largest_child_[event]; }
    /// Event of the highest element of the object.
    [[nodiscard]] Event highest(Event event) const { return highest_[event]; }

    /// Number of events with a value of at least (above: of more than) tau.
    [[nodiscard]] std::size_t rank(double tau, bool above = false) const;
    /// The events whose zones contain the rank, ascending.
    [[nodiscard]] std::vector<Event> zones(std::size_t rank) const;
    /// The zone of a lower rank that contains the object of an event.
    [[nodiscard]] Event zone_at(Event event, std::size_t rank) const {
        return climber_.climb(event, [rank](Event e) { return e.index() < rank; });
    }
    /// Number of elements with a value of at least (above: of more than) tau.
    [[nodiscard]] std::size_t element_rank(double tau, bool above = false) const;
    /// Calls visit(arc) for the arcs of the contour tree that contain the rank (of elements).
    template <class Visit>
    void for_contours(std::size_t rank, Visit&& visit) const {
        if (rank == 0) return;
        const auto visit_arc = [&](std::size_t arc) { visit(Element(arc)); };
        contours().highest_other.for_each_at_least(0, rank, Element(rank), visit_arc);
        contours().lowest_other.for_each_at_least(rank, arrays_.contours.nodes(), Element(rank - 1), visit_arc);
    }
    /// Of an arc that contains the rank: is its contour an outer one, and the lowest element of its low component.
    [[nodiscard]] bool is_outer(Element arc) const { return arrays_.contours.other[arc] > arc; }
    [[nodiscard]] Element lowest(Element arc, std::size_t rank) const { return lowest_with(arrays_.contours.lower(arc), rank); }
    /// The lowest element of the low component that holds a Low element.
    [[nodiscard]] Element lowest_with(Element element, std::size_t rank) const {
        return contours().low.lowest[contours().climber.climb(element, [rank](Element x) { return x.index() >= rank; })];
    }
    [[nodiscard]] const AnalysisArrays<Number>& arrays() const { return arrays_; }

private:
    [[nodiscard]] const ActiveContours<Number>& contours() const {
        return *contours_.get([this] { return std::make_unique<ActiveContours<Number>>(arrays_.contours); });
    }

    const AnalysisArrays<Number>& arrays_;
    MaxPyramid<Event, std::greater<>> parents_;
    LevelAncestor<Event> climber_;
    ByEvent<Number, Event> highest_, largest_child_;
    ByEvent<Number, Number> object_voxels_;
    Lazy<std::unique_ptr<ActiveContours<Number>>> contours_;
};

}  // namespace isoatlas
