// ObjectTree: merge tree of superlevel or sublevel sets, so that objects and cavities are ranked by the same code.
//
// Superlevel sets: the criticality tree; the height of a sample is its value. Sublevel sets: the tree of low components
// (analysis/sublevel_tree.h); the height is the value negated. Events are numbered by descending height, children before their parents.
#pragma once

#include <cstdint>
#include <span>

#include "analysis/analysis_data.h"
#include "base/memory_limit.h"
#include "field/volume_view.h"

namespace isoatlas {

template <class Id>
struct ObjectTree {
    std::span<const Id> parent;      ///< per event; the root is its own
    std::span<const double> height;  ///< per event
    std::span<const Id> voxels;      ///< per event, of its zone
    std::span<const Id> zone;        ///< per voxel
    double sign = 1;                 ///< height = sign * value
    std::int64_t main_leaf = -1;     ///< the branch of this event continues at every merge; -1: the one of largest hypervolume does

    [[nodiscard]] std::size_t size() const { return parent.size(); }
    [[nodiscard]] bool is_root(std::size_t e) const { return parent[e] == static_cast<Id>(e); }

    /// Calls visit(voxel, height) for all samples in order.
    template <class Visit>
    void for_heights(const VolumeView& volume, Visit&& visit) const {
        visit_samples(volume, [&](auto samples) {
            BudgetPoll memory;
            for (std::size_t v = 0; v < samples.size(); ++v) {
                memory.step(sizeof samples[v] + sizeof(Id));
                visit(v, sign * static_cast<double>(samples[v]));
            }
        });
    }
};

/// Per event: its value.
template <class Id>
[[nodiscard]] BigVector<double> event_values(const AnalysisArrays<Id>& arrays) {
    BigVector<double> values(arrays.tree.size());
    BudgetPoll memory;
    for (std::size_t e = 0; e < values.size(); ++e) {
        memory.step(BudgetPoll::kTouch);
        values[e] = arrays.value[arrays.tree.top[e]];
    }
    return values;
}

/// values: of event_values(); both must live as long as the result.
template <class Id>
[[nodiscard]] ObjectTree<Id> superlevel_tree(const AnalysisArrays<Id>& arrays, std::span<const double> values) {
    return {arrays.tree.parent, values, arrays.voxels, arrays.zone, 1, -1};
}

}  // namespace isoatlas
