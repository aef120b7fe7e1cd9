// The regular grid as a domain: the slab passes of this folder, put together.
//
// Domain is what the stages behind ask for, and all they ask for: a critical set, a basin per vertex, positions of elements.
// Grids of other dimensions and simplicial meshes join by offering the same (docs/theory/2-critical-elements.md#other-dimensions).
#pragma once

#include <array>
#include <concepts>
#include <utility>

#include "critical/basins.h"
#include "critical/critical_set.h"
#include "critical/grid_scan.h"
#include "isoatlas/context.h"

namespace isoatlas {

/// What critical() gives: the sorted critical elements, and for every vertex the number of a maximum above it (Basins::number).
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
