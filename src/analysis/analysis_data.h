// Data of an Analysis: the arrays of the engine for one width of ids, and the indices that accessors build on first use.
#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <variant>
#include <vector>

#include "base/lazy.h"
#include "isoatlas/analysis.h"
#include "tree/criticality_tree.h"

namespace isoatlas {

template <class Id>
struct AnalysisArrays {
    // per critical element, descending
    BigVector<double> value;
    BigVector<std::uint64_t> code;
    BigVector<Id> level;       ///< highest element of its level
    ContourTree<Id> contours;  ///< n + 1 nodes, the last is the outside
    CriticalityTree<Id> tree;
    EventMeasures<Id> measures;
    BigVector<Id> voxels;  ///< per event, of its zone; empty without zones
    BigVector<Id> zone;    ///< per voxel; empty without zones
};

/// Compressed lists: the items of i are item[first[i]] .. item[first[i + 1]].
template <class Id>
struct Lists {
    std::vector<Id> first, item;
};

/// Built on first use from the arrays.
template <class Id>
struct LevelIndex {
    std::vector<Id> arcs;           ///< nodes whose arc has a length, by (upper, lower)
    std::vector<Id> levels;         ///< roots of the non-trivial levels, descending
    Lists<Id> level_in, level_out;  ///< genera, sorted, by position in `levels`
    Lists<Id> event_levels;         ///< positions in `levels`, by event
};

/// Built on first use from the arrays; most callers need no levels, which cost more.
template <class Id>
struct EventIndex {
    std::vector<std::int64_t> first_child;  ///< by event
    std::vector<EventId> children;
    std::vector<Id> object_voxels;  ///< by event: of its object at the low end of the zone; empty without zones
};

template <class Id>
LevelIndex<Id> index_levels(const AnalysisArrays<Id>& arrays);
template <class Id>
EventIndex<Id> index_events(const AnalysisArrays<Id>& arrays);

template <class Id>
struct IndexedArrays {
    AnalysisArrays<Id> arrays;
    Lazy<LevelIndex<Id>> lazy_levels;
    Lazy<EventIndex<Id>> lazy_events;

    [[nodiscard]] const LevelIndex<Id>& levels() const {
        return lazy_levels.get([this] { return index_levels(arrays); });
    }
    [[nodiscard]] const EventIndex<Id>& events() const {
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
