// Objects and low components at one isovalue, and the contours between them.
//
// Components are numbered in scan order of their first run; low component 0 is the outside. The surfaces form a tree
// (docs/theory/1-elements-and-order.md#objects-low-components-contours): every object has one outer contour, every low component except the
// outside one contour towards the outside. So contour c < objects is the outer contour of object c, and contour objects + l - 1 is the
// wall of the cavity l >= 1.
#pragma once

#include <cstdint>
#include <vector>

#include "base/check.h"
#include "base/id_array.h"
#include "levelset/runs.h"
#include "levelset/tau_level.h"

namespace isoatlas {

// Numbers at one isovalue, unlike the ids in Cut, which are voxels.
using ObjectNumber = StrongId<struct ObjectNumberTag, std::int32_t>;
using LowNumber = StrongId<struct LowNumberTag, std::int32_t>;  ///< of a low component; 0: the outside
using ContourNumber = StrongId<struct ContourNumberTag, std::int64_t>;

struct Components {
    Runs runs;
    IdArray<RunId, std::int32_t> of_run;            ///< object of a High run, low component of a Low run: object_of(), low_of()
    IdArray<ObjectNumber, LowNumber> outer_low;     ///< the low component towards the outside
    IdArray<LowNumber, ObjectNumber> outer_object;  ///< the object around it; none for the outside
    IdArray<ObjectNumber, VoxelId> highest;         ///< its highest voxel (ties: larger index)
    IdArray<LowNumber, VoxelId> lowest;             ///< its lowest voxel (ties: smaller index); none for the outside

    [[nodiscard]] ObjectNumber object_of(RunId run) const { return ObjectNumber(of_run[run]); }
    [[nodiscard]] LowNumber low_of(RunId run) const { return LowNumber(of_run[run]); }
    [[nodiscard]] std::int64_t objects() const { return static_cast<std::int64_t>(outer_low.size()); }
    [[nodiscard]] std::int64_t lows() const { return static_cast<std::int64_t>(outer_object.size()); }
    [[nodiscard]] std::int64_t contours() const { return objects() + lows() - 1; }
    /// The contour between an object and a low component that touch. Anything else is a bug: the contours form a tree.
    [[nodiscard]] ContourNumber contour_between(ObjectNumber object, LowNumber low) const {
        if (outer_low[object] == low) return outer_contour(object);
        ISOATLAS_CHECK(outer_object[low] == object);
        return wall(low);
    }
    [[nodiscard]] static ContourNumber outer_contour(ObjectNumber object) { return ContourNumber(object.number()); }
    [[nodiscard]] ContourNumber wall(LowNumber cavity) const { return ContourNumber(objects() + cavity.number() - 1); }
    [[nodiscard]] bool is_outer(ContourNumber contour) const { return contour.number() < objects(); }
    [[nodiscard]] ObjectNumber object_of_contour(ContourNumber contour) const {
        return is_outer(contour) ? ObjectNumber(contour.number()) : outer_object[cavity_of(contour)];
    }
    /// Id as in Cut: the highest voxel of the object, or the lowest of the cavity.
    [[nodiscard]] VoxelId contour_id(ContourNumber contour) const {
        return is_outer(contour) ? highest[ObjectNumber(contour.number())] : lowest[cavity_of(contour)];
    }

private:
    [[nodiscard]] LowNumber cavity_of(ContourNumber wall) const { return LowNumber(wall.number() - objects() + 1); }
};

/// Components of the samples. Connected are: 6-neighbours (4 in 2D) of one class, and the diagonal of a 4-hit face that its face point
/// joins (docs/theory/1-elements-and-order.md#ambiguous-faces); with the trilinear interpolant, also the two regions of a cell that a
/// tunnel joins. Cost: O(runs) beyond the bits, and O(active cells) for tunnels. Same result for any threads and slabs.
[[nodiscard]] Components find_components(const TauLevel& level, double tunnel_height, const Context& context);

/// Cursor along a row: the component of ascending positions, as in Components::of_run. Outside the volume everything is low component 0.
class ComponentCursor {
public:
    ComponentCursor(const Components& components, std::int64_t y, std::int64_t z) {
        const Extent& extent = components.runs.extent;
        if (y < 0 || z < 0 || y >= extent.size[1] || z >= extent.size[2]) return;
        const RunRow row = components.runs.row(y, z);
        next_change_ = row.change;
        end_ = row.change + row.changes;
        component_ = &components.of_run[row.first_run];
    }
    /// Component at a position that is not smaller than the one of the call before.
    [[nodiscard]] std::int32_t at(std::int64_t position) {
        if (component_ == nullptr) return 0;
        while (next_change_ != end_ && *next_change_ <= position) {
            ++next_change_;
            ++component_;
        }
        return *component_;
    }

private:
    const std::uint32_t* next_change_ = nullptr;
    const std::uint32_t* end_ = nullptr;
    const std::int32_t* component_ = nullptr;
};

}  // namespace isoatlas
