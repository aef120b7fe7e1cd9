// Representatives of a critical element: the extrema that its neighbourhood leads to (docs/theory/3-trees.md#only-critical-elements).
// In the literature: the edges of an extremum graph (Lukasczyk et al., ExTreeM, 2023).
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "critical/basins.h"
#include "field/order.h"

namespace isoatlas {

/// basin: of all voxels, finished, in the direction of the lookup.
template <class Id>
class RepresentativeLookup {
public:
    RepresentativeLookup(const Extent& extent, std::span<const Id> basin) : extent_(extent), steps_(extent), basin_(basin) {}

    /// Maxima above an element; equal when h0 < 2. basin: upwards.
    [[nodiscard]] std::array<Id, 2> above(ElementCode code) const {
        switch (code.kind()) {
            case CodeKind::vertex: return code.h0() == 2 ? both(code.index(), code.axis()) : same(code.index());
            case CodeKind::face: return code.bd_high() ? corners(code, 1, code.h0()) : corners(code, 0, code.h0());
            case CodeKind::body_open: return {of(body_voxel(code, 0)), of(body_voxel(code, 1))};
            case CodeKind::body_close: break;
        }
        return same(body_voxel(code, 2));
    }
    /// Minima below it, or the outside; equal when l0 < 2. basin: downwards.
    [[nodiscard]] std::array<Id, 2> below(ElementCode code) const {
        switch (code.kind()) {
            case CodeKind::vertex:
                return code.l0() == 2 ? both(code.index(), code.h0() == 2 ? 1 - code.axis() : code.axis()) : same(code.index());
            case CodeKind::face: return code.bd_high() ? corners(code, 0, code.l0()) : corners(code, 1, code.l0());
            case CodeKind::body_open: break;
            case CodeKind::body_close: return {of(body_voxel(code, 0)), of(body_voxel(code, 1))};
        }
        return same(body_voxel(code, 2));
    }

private:
    [[nodiscard]] Id of(std::int64_t v) const { return Basins<Id>::number(basin_[v]); }
    [[nodiscard]] std::array<Id, 2> same(std::int64_t v) const { return {of(v), of(v)}; }
    /// The two neighbours along an axis. Outside the grid lies the outside.
    [[nodiscard]] std::array<Id, 2> both(std::int64_t v, int axis) const {
        const std::int64_t step = steps_.axis[axis], size = extent_.size[axis], position = v / step % size;
        return {position > 0 ? of(v - step) : Id{0}, position + 1 < size ? of(v + step) : Id{0}};
    }
    /// A diagonal of a face: corners first and first + 2.
    [[nodiscard]] std::array<Id, 2> corners(ElementCode code, int first, int count) const {
        const Id a = of(steps_.face_voxel(code.index(), first));
        return {a, count == 2 ? of(steps_.face_voxel(code.index(), first + 2)) : a};
    }
    [[nodiscard]] std::int64_t body_voxel(ElementCode code, int i) const { return steps_.cell_corner(code.cell(), code.body_corner(i)); }

    const Extent& extent_;
    GridSteps steps_;
    std::span<const Id> basin_;
};

}  // namespace isoatlas
