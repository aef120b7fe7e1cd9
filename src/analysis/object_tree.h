// ObjectTree: merge tree of superlevel or sublevel sets, so that objects and cavities are ranked by the same code.
//
// Superlevel sets: the criticality tree; the height of a sample is its value. Sublevel sets: the tree of low components
// (analysis/sublevel_tree.h); the height is the value negated. Events are numbered by descending height, children before their parents.
#pragma once

#include <cstdint>
#include <span>

#include "analysis/analysis_data.h"
#include "base/big_vector.h"
#include "base/id_array.h"
#include "base/streamed.h"
#include "field/volume_view.h"

namespace isoatlas {

template <class Number>
struct ObjectTree {
    IdSpan<EventId, const Number> parents;  ///< the root is its own
    IdSpan<EventId, const double> height;
    IdSpan<EventId, const Number> voxels;  ///< of its zone
    IdSpan<VoxelId, const Number> zones;
    double sign = 1;                      ///< height = sign * value
    EventId main_leaf = EventId::none();  ///< the branch of this event continues at every merge; none: the one of largest hypervolume does

    [[nodiscard]] std::size_t size() const { return parents.size(); }
    [[nodiscard]] EventId parent(EventId e) const { return EventId(parents[e]); }
    [[nodiscard]] bool is_root(EventId e) const { return parent(e) == e; }
    [[nodiscard]] EventId zone(VoxelId v) const { return EventId(zones[v]); }

    /// Calls visit(voxel, height) for all samples in order. also: what a visit brings into memory, besides the sample and its zone.
    template <class Visit>
    void for_heights(const VolumeView& volume, StepBytes also, Visit&& visit) const {
        visit_samples(volume, [&]<class T>(std::span<const T> samples) {
            for (const VoxelId v : streamed<VoxelId>(samples.size(), {sizeof(T) + sizeof(Number) + also.bytes}))
                visit(v, sign * static_cast<double>(samples[v.index()]));
        });
    }
};

/// Per event: its value.
template <class Number>
[[nodiscard]] BigVector<double> event_values(const AnalysisArrays<Number>& arrays) {
    BigVector<double> values(arrays.tree.size());
    for (const auto e : streamed<EventIdOf<Number>>(values.size(), at_random())) values[e.index()] = arrays.value[arrays.tree.top[e]];
    return values;
}

/// values: of event_values(); both must live as long as the result.
template <class Number>
[[nodiscard]] ObjectTree<Number> superlevel_tree(const AnalysisArrays<Number>& arrays, std::span<const double> values) {
    return {IdSpan<EventId, const Number>(numbers_of<EventIdOf<Number>>(arrays.tree.parent.items())), IdSpan<EventId, const double>(values),
            IdSpan<EventId, const Number>(arrays.voxels.items()), IdSpan<VoxelId, const Number>(arrays.zone.items())};
}

}  // namespace isoatlas
