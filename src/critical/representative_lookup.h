// Representatives of a critical element: the extrema that its neighbourhood leads to (docs/theory/3-trees.md#only-critical-elements).
// In the literature: the edges of an extremum graph (Lukasczyk et al., ExTreeM, 2023).
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "critical/basins.h"
#include "critical/ids.h"
#include "field/order.h"

namespace isoatlas {

/// basin: of all voxels, finished, in the direction of the lookup.
template <class Number>
class RepresentativeLookup {
public:
    using Maximum = MaximumIdOf<Number>;
    using Minimum = MinimumIdOf<Number>;

    RepresentativeLookup(const Extent& extent, std::span<const Number> basin) : extent_(extent), steps_(extent), basin_(basin) {}

    /// Maxima above an element; equal when h0 < 2. basin: upwards.
    [[nodiscard]] std::array<Maximum, 2> above(ElementCode code) const {
        switch (code.kind()) {
            case CodeKind::vertex: return code.h0() == 2 ? both<Maximum>(code.index(), code.axis()) : same<Maximum>(code.index());
            case CodeKind::face: return corners<Maximum>(code, code.bd_high() ? 1 : 0, code.h0());
            case CodeKind::body_open: return {of<Maximum>(body_voxel(code, 0)), of<Maximum>(body_voxel(code, 1))};
            case CodeKind::body_close: break;
        }
        return same<Maximum>(body_voxel(code, 2));
    }
    /// Minima below it, or the outside; equal when l0 < 2. basin: downwards.
    [[nodiscard]] std::array<Minimum, 2> below(ElementCode code) const {
        switch (code.kind()) {
            case CodeKind::vertex:
                return code.l0() == 2 ? both<Minimum>(code.index(), code.h0() == 2 ? 1 - code.axis() : code.axis())
                                      : same<Minimum>(code.index());
            case CodeKind::face: return corners<Minimum>(code, code.bd_high() ? 0 : 1, code.l0());
            case CodeKind::body_open: break;
            case CodeKind::body_close: return {of<Minimum>(body_voxel(code, 0)), of<Minimum>(body_voxel(code, 1))};
        }
        return same<Minimum>(body_voxel(code, 2));
    }

private:
    template <class Extremum>
    [[nodiscard]] Extremum of(std::int64_t v) const {
        return Extremum(Basins<Number>::number(basin_[v]));
    }
    template <class Extremum>
    [[nodiscard]] std::array<Extremum, 2> same(std::int64_t v) const {
        return {of<Extremum>(v), of<Extremum>(v)};
    }
    /// The two neighbours along an axis. Outside the grid lies the outside.
    template <class Extremum>
    [[nodiscard]] std::array<Extremum, 2> both(std::int64_t v, int axis) const {
        const std::int64_t step = steps_.axis[axis], size = extent_.size[axis], position = v / step % size;
        return {position > 0 ? of<Extremum>(v - step) : Extremum(0), position + 1 < size ? of<Extremum>(v + step) : Extremum(0)};
    }
    /// A diagonal of a face: corners first and first + 2.
    template <class Extremum>
    [[nodiscard]] std::array<Extremum, 2> corners(ElementCode code, int first, int count) const {
        const Extremum a = of<Extremum>(steps_.face_voxel(code.index(), first));
        return {a, count == 2 ? of<Extremum>(steps_.face_voxel(code.index(), first + 2)) : a};
    }
    [[nodiscard]] std::int64_t body_voxel(ElementCode code, int i) const { return steps_.cell_corner(code.cell(), code.body_corner(i)); }

    const Extent& extent_;
    GridSteps steps_;
    std::span<const Number> basin_;
};

}  // namespace isoatlas
