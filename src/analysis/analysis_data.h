// Data of an Analysis: the arrays of the engine for one width of ids, and the indices that accessors build on first use.
#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <variant>
#include <vector>

#include "base/lazy.h"
#include "isoatlas/analysis.h"
#include "tree/contour_tree.h"
#include "tree/criticality_tree.h"

namespace isoatlas {

template <class Number>
struct AnalysisArrays {
    // of critical elements, descending
    ByElement<Number, double> value;
    ByElement<Number, std::uint64_t> code;
    ByElement<Number, ElementIdOf<Number>> level;  ///< highest element of its level
    ContourTree<Number> contours;                  ///< n + 1 nodes, the last is the outside
    CriticalityTree<Number> tree;
    EventMeasures<Number> measures;
    ByEvent<Number, Number> voxels;  ///< of its zone; empty without zones
    ByVoxel<Number, Number> zone;    ///< number of an event, in the memory that basins had; empty without zones

    [[nodiscard]] EventIdOf<Number> zone_of(SameKind<VoxelIdOf<Number>> auto voxel) const { return EventIdOf<Number>(zone[voxel]); }
};

/// Compressed lists: the items of i are item[first[i]] .. item[first[i + 1]].
template <class Number>
struct Lists {
    std::vector<Number> first, item;
};

/// Built on first use from the arrays.
template <class Number>
struct LevelIndex {
    std::vector<ElementIdOf<Number>> arcs;    ///< nodes whose arc has a length, by (upper, lower)
    std::vector<ElementIdOf<Number>> levels;  ///< roots of the non-trivial levels, descending
    Lists<Number> level_in, level_out;        ///< genera, sorted, by position in `levels`
    Lists<Number> event_levels;               ///< positions in `levels`, by event
};

/// Built on first use from the arrays; most callers need no levels, which cost more.
template <class Number>
struct EventIndex {
    std::vector<std::int64_t> first_child;  ///< by event
    std::vector<EventId> children;
    std::vector<Number> object_voxels;  ///< by event: of its object at the low end of the zone; empty without zones
};

template <class Number>
LevelIndex<Number> index_levels(const AnalysisArrays<Number>& arrays);
template <class Number>
EventIndex<Number> index_events(const AnalysisArrays<Number>& arrays);

template <class Number>
struct IndexedArrays {
    AnalysisArrays<Number> arrays;
    Lazy<LevelIndex<Number>> lazy_levels;
    Lazy<EventIndex<Number>> lazy_events;

    [[nodiscard]] const LevelIndex<Number>& levels() const {
        return lazy_levels.get([this] { return index_levels(arrays); });
    }
    [[nodiscard]] const EventIndex<Number>& events() const {
        return lazy_events.get([this] { return index_events(arrays); });
    }
};

struct Analysis::Data {
    Extent extent;
    Interpolant interpolant = Interpolant::faces;
    double tunnel_height = 0;
    std::variant<std::unique_ptr<IndexedArrays<std::uint32_t>>, std::unique_ptr<IndexedArrays<std::uint64_t>>> arrays;

    template <class Function>
    decltype(auto) visit(Function&& function) const {
        return std::visit([&](const auto& held) -> decltype(auto) { return function(std::as_const(*held)); }, arrays);
    }
    template <class Function>
    decltype(auto) visit(Function&& function) {
        return std::visit([&](auto& held) -> decltype(auto) { return function(*held); }, arrays);
    }
};

}  // namespace isoatlas
