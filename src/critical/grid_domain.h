// The regular grid as a domain: the slab passes of this folder, put together.
//
// It implements Domain (critical/domain.h), as grids of other dimensions and simplicial meshes would
// (docs/theory/2-critical-elements.md#other-dimensions).
//
// The notation of this folder:
//   High, Low       a sample or element of value >= tau, < tau; everything outside the grid (EXT) is Low
//   vertex          a voxel
//   element         a vertex, the face point of an ambiguous face, or a body point of a cell; ordered by field/order.h
//   F, a b c d      an ambiguous face and its corners (field/cell.h); a' b' c' d' lie behind them on the opposite face of a cell
//   type H, L       of a face in a cell: its Highs are joined above F in this cell; its Lows are joined below (faces.h)
//   B1, B2          body points: an opening one above its face, a closing one below (bodies.h)
//   h0, l0          how many objects meet just above an element, how many low components just below; (h0, l0) is its type
//   link            the neighbours of a vertex that lie above it, one bit each (links.h)
//   basin           of a vertex: the number of an extremum at the end of a monotone path (basins.h)
//   representative  the basin of a neighbour: stands for a component that meets at an element (representative_lookup.h)
//   rank            position of a critical element in descending total order
//   slab            consecutive slices, the unit of parallel work; tile: a box of voxels, the unit of work in bounded memory (tiling.h)
//
// The stages: scan (links and critical elements of all slabs), basins, representatives, sort by rank.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <utility>

#include "critical/basins.h"
#include "critical/domain.h"
#include "critical/grid_scan.h"
#include "isoatlas/context.h"

namespace isoatlas {

/// Maxima in raster order. Cost: O(elements), a bit a voxel.
template <class Number>
[[nodiscard]] ElementsOfMaxima<Number> elements_of_maxima(ByElementView<Number, std::uint64_t> code, const Extent& extent);

template <class T, class NumberType>
class GridDomain {
public:
    using Number = NumberType;
    using Sample = T;

    /// scan: of scan_grid(); empty when critical() is not called.
    GridDomain(GridView<T> grid, GridScan scan) : grid_(grid), above_{GridSteps(grid.extent)}, scan_(std::move(scan)) {}

    /// Resolves basins and sorts; consumes the scan. Cost: O(voxels + c log c); 5 bytes a voxel and 64 a critical element while it runs
    /// with 32-bit ids, 4 bytes a voxel more when the basins are kept.
    [[nodiscard]] Criticals<Number> critical(bool keep_basins, const Context& context);
    [[nodiscard]] std::span<const T> samples() const { return {grid_.samples, static_cast<std::size_t>(grid_.extent.voxels())}; }
    /// Maxima are numbered in raster order.
    [[nodiscard]] ElementsOfMaxima<Number> elements_of_maxima(ByElementView<Number, std::uint64_t> code) const {
        return isoatlas::elements_of_maxima<Number>(code, grid_.extent);
    }
    void for_parts(const Context& context, const Phase& phase, const std::function<void(std::size_t, std::size_t)>& work) const;

private:
    GridView<T> grid_;
    Above above_;
    GridScan scan_;
};

}  // namespace isoatlas
