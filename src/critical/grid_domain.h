// The regular grid as a domain: the slab passes of this folder, put together.
//
// Domain is what the stages behind ask for, and all they ask for: a critical set, a basin per vertex, positions of elements.
// Grids of other dimensions and simplicial meshes join by offering the same (theory.md section 10).
#pragma once

#include <array>
#include <concepts>

#include "critical/basins.h"
#include "critical/critical_set.h"
#include "critical/scan.h"
#include "isoatlas/context.h"

namespace isoatlas {

/// What critical() gives: the sorted critical elements, and for every vertex the number of a maximum above it (Basins::number).
template <class Id>
struct Criticals {
    CriticalSet<Id> set;
    BigVector<Id> basin;
};

template <class D>
concept Domain = requires(const D& domain, const Context& context, std::uint64_t code, KeyedElement element) {
    typename D::Id;
    typename D::Sample;
    { domain.critical(context) } -> std::same_as<Criticals<typename D::Id>>;
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

    /// tunnel_height: of tunnel_height_of (critical/bodies.h).
    GridDomain(GridView<T> grid, double tunnel_height) : grid_(grid), above_{GridSteps(grid.extent)}, tunnel_height_(tunnel_height) {}

    /// Scans, resolves basins, sorts. Cost: O(voxels + c log c); memory 9 bytes a voxel and 64 a critical element while it runs.
    [[nodiscard]] Criticals<Id> critical(const Context& context) const;
    [[nodiscard]] std::array<double, 3> position(std::uint64_t code) const { return element_position(ElementCode{code}, grid_.extent); }
    [[nodiscard]] bool above(const KeyedElement& p, const KeyedElement& q) const { return above_(p, q); }
    [[nodiscard]] std::int64_t vertices() const { return grid_.extent.voxels(); }
    [[nodiscard]] T sample(std::int64_t v) const { return grid_.samples[v]; }

private:
    GridView<T> grid_;
    Above above_;
    double tunnel_height_;
};

/// Slices per slab: what the context asks for, or enough slabs to keep every thread busy.
[[nodiscard]] std::int64_t slab_height(const Extent& extent, const Context& context);

}  // namespace isoatlas
