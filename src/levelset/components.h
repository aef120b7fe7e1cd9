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
#include "levelset/runs.h"
#include "levelset/tau_level.h"

namespace isoatlas {

struct Components {
    Runs runs;
    std::vector<std::int32_t> of_run;        ///< object of a High run, low component of a Low run
    std::vector<std::int32_t> outer_low;     ///< per object: the low component towards the outside
    std::vector<std::int32_t> outer_object;  ///< per low component: the object around it; -1 for the outside
    std::vector<std::int64_t> highest;       ///< per object: its highest voxel (ties: larger index)
    std::vector<std::int64_t> lowest;        ///< per low component: its lowest voxel (ties: smaller index); -1 for the outside

    [[nodiscard]] std::int64_t objects() const { return static_cast<std::int64_t>(outer_low.size()); }
    [[nodiscard]] std::int64_t lows() const { return static_cast<std::int64_t>(outer_object.size()); }
    [[nodiscard]] std::int64_t contours() const { return objects() + lows() - 1; }
    /// The contour between an object and a low component that touch. Anything else is a bug: the contours form a tree.
    [[nodiscard]] std::int64_t contour_between(std::int32_t object, std::int32_t low) const {
        if (outer_low[object] == low) return object;
        ISOATLAS_CHECK(outer_object[low] == object);
        return objects() + low - 1;
    }
    [[nodiscard]] std::int64_t object_of_contour(std::int64_t contour) const {
        return contour < objects() ? contour : outer_object[contour - objects() + 1];
    }
    /// Id as in Cut: the highest voxel of the object, or the lowest of the cavity.
    [[nodiscard]] std::int64_t contour_id(std::int64_t contour) const {
        return contour < objects() ? highest[contour] : lowest[contour - objects() + 1];
    }
};

/// Components of the samples. Connected are: 6-neighbours (4 in 2D) of one class, and the diagonal of a 4-hit face that its face point
/// joins (docs/theory/1-elements-and-order.md#ambiguous-faces); with the trilinear interpolant, also the two regions of a cell that a
/// tunnel joins. Cost: O(runs) beyond the bits, and O(active cells) for tunnels. Same result for any threads and slabs.
[[nodiscard]] Components find_components(const TauLevel& level, double tunnel_height, const Context& context);

/// Cursor along a row: the component of ascending positions. Outside the volume everything is low component 0.
class ComponentCursor {
public:
    ComponentCursor(const Components& components, std::int64_t y, std::int64_t z) {
        const Extent& extent = components.runs.extent;
        if (y < 0 || z < 0 || y >= extent.size[1] || z >= extent.size[2]) return;
        const RunRow row = components.runs.row(y, z);
        next_change_ = row.change;
        end_ = row.change + row.changes;
        component_ = components.of_run.data() + row.first_run;
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
