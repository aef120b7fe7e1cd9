// The regular grid as a domain: the slab passes of this folder, put together.
//
// Domain is the interface to the later stages: a critical set, a basin per vertex, positions of elements.
// Grids of other dimensions and simplicial meshes would implement it (docs/theory/2-critical-elements.md#other-dimensions).
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

#include <array>
#include <concepts>
#include <utility>

#include "critical/basins.h"
#include "critical/critical_set.h"
#include "critical/grid_scan.h"
#include "isoatlas/context.h"

namespace isoatlas {

/// Result of critical(): the sorted critical elements, and for every vertex the number of a maximum above it (Basins::number).
template <class Id>
struct Criticals {
    CriticalSet<Id> set;
    BigVector<Id> basin;  ///< empty when it was not to be kept
};

template <class D>
concept Domain = requires(D& domain, const Context& context, std::uint64_t code, KeyedElement element) {
    typename D::Id;
    typename D::Sample;
    { domain.critical(true, context) } -> std::same_as<Criticals<typename D::Id>>;
    { domain.position(code) } -> std::same_as<std::array<double, 3>>;
    { domain.above(element, element) } -> std::same_as<bool>;  // the total order
    { domain.vertices() } -> std::same_as<std::int64_t>;
    { domain.sample(std::int64_t{}) } -> std::same_as<typename D::Sample>;
};

template <class T, class IdType>
class GridDomain {
public:
    using Id = IdType;
    using Sample = T;

    GridDomain(GridView<T> grid, GridScan scan) : grid_(grid), above_{GridSteps(grid.extent)}, scan_(std::move(scan)) {}

    /// Resolves basins and sorts; consumes the scan. Cost: O(voxels + c log c); 5 bytes a voxel and 64 a critical element while it runs
    /// with 32-bit ids, 4 bytes a voxel more when the basins are kept.
    [[nodiscard]] Criticals<Id> critical(bool keep_basins, const Context& context);
    [[nodiscard]] std::array<double, 3> position(std::uint64_t code) const { return element_position(ElementCode{code}, grid_.extent); }
    [[nodiscard]] bool above(const KeyedElement& p, const KeyedElement& q) const { return above_(p, q); }
    [[nodiscard]] std::int64_t vertices() const { return grid_.extent.voxels(); }
    [[nodiscard]] T sample(std::int64_t v) const { return grid_.samples[v]; }

private:
    GridView<T> grid_;
    Above above_;
    GridScan scan_;
};

}  // namespace isoatlas
