// What an analysis is made of, and a store keeps: the critical elements and the arcs of the contour tree. All else follows from them.
//
// In the literature: an unaugmented contour tree, its nodes with their values.
#pragma once

#include <optional>
#include <variant>

#include "field/volume_view.h"
#include "isoatlas/analysis.h"
#include "tree/contour_tree.h"

namespace isoatlas {

template <class Number>
struct ArcArrays {
    ByElement<Number, double> value;        ///< of critical elements, descending
    ByElement<Number, std::uint64_t> code;  ///< of critical elements (field/order.h)
    ContourTree<Number> contours;           ///< `other` alone: n + 1 nodes, the last is the outside
    ByVoxel<Number, Number> basin;          ///< of its maximum (critical/basins.h); empty when it is not known
    ByVoxel<Number, Number> element{};      ///< the one that it belongs to (zones/count_voxels.h), instead of basin; empty: not known
};

struct ContourArcs {
    Extent extent;
    Interpolant interpolant = Interpolant::faces;
    double tunnel_height = 0;
    std::variant<ArcArrays<std::uint32_t>, ArcArrays<std::uint64_t>> arrays;

    [[nodiscard]] std::size_t elements() const {
        return std::visit([](const auto& held) { return held.code.size(); }, arrays);
    }
};

/// Voxels per critical element (zones/count_voxels.h), as wide as the ids of the arcs.
using ElementVoxels = std::variant<ByElement<std::uint32_t, std::uint32_t>, ByElement<std::uint64_t, std::uint64_t>>;

/// Works while memory is limited (base/memory_limit.h). Throws Error: cancelled, resource. Cost: O(voxels + c log c) for c elements.
[[nodiscard]] ContourArcs compute_arcs(const VolumeView& volume, const AnalysisOptions& options, const Context& context);

/// Leaves the element of every voxel in arcs, where the paths to them fit into memory. Throws Error: cancelled, resource.
[[nodiscard]] ElementVoxels count_voxels(ContourArcs& arcs, const VolumeView& volume, const Context& context);

/// The trees alone. Takes value, code and arcs out of `arcs`; what it knows of voxels stays. Nothing: the arcs are not those of a contour
/// tree, a damaged store. Throws Error{cancelled}. Cost: O(n alpha).
[[nodiscard]] std::optional<Analysis> restored_trees(ContourArcs& arcs, const Context& context);

/// The whole analysis: trees, and the zone of every voxel. arcs: of this volume; voxels: of count_voxels(). Throws Error{cancelled}. Cost:
/// O(n alpha) and a pass over the voxels; as add_zones() where arcs does not hold their elements.
[[nodiscard]] Analysis make_analysis(ContourArcs arcs, const ElementVoxels& voxels, const VolumeView& volume, const Context& context);

/// Finds the zone of every voxel by the trees. Returns false when the trees are not of these samples: a damaged store. Throws
/// Error{cancelled}. Cost: the links and basins of all voxels, random access to what is proportional to the critical elements.
[[nodiscard]] bool add_zones(Analysis& analysis, const VolumeView& volume, const Context& context);

}  // namespace isoatlas
