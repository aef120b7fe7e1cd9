// The engine from critical elements to zones, for any domain: the flow of the whole library on one page.
//
// In the literature: merge trees and the contour tree of an extremum graph (Lukasczyk et al., ExTreeM, 2023), and the segmentation by them.
#pragma once

#include <utility>

#include "analysis/trees.h"
#include "base/big_vector.h"
#include "base/paced_fill.h"
#include "base/parallel.h"
#include "critical/domain.h"
#include "tree/heavy_paths.h"
#include "zones/label.h"

namespace isoatlas {

/// Finds the zone of every vertex and counts them, by the trees. basin: of critical(); its memory becomes that of arrays.zone.
/// Cost: O(1) expected a vertex; random access to what is proportional to the critical elements.
template <Domain D>
void make_zones(const D& domain, ByVoxel<typename D::Number, typename D::Number> basin, AnalysisArrays<typename D::Number>& arrays,
                const Context& context) {
    using Number = typename D::Number;
    using Sample = typename D::Sample;
    const CriticalityTree<Number>& tree = arrays.tree;
    const DescendingTree<Number> events{tree.parent, arrays.value, tree.top, tree.event_of_element};
    ElementsOfMaxima<Number> maxima;
    ByEvent<Number, HeavyNode<Number>> nodes;
    run_both(context.threads, [&] { maxima = domain.elements_of_maxima(arrays.code); }, [&] { nodes = weigh(events); });
    const HeavyPathDecomposition<Number, ComparisonValue<Sample>> paths(events, std::move(nodes), maxima, context.threads);
    release(maxima.items());
    fill_fresh(arrays.voxels.items(), tree.size(), Number{0});
    const std::span<Number> basin_to_zone = basin.items();
    domain.for_parts(context, kAnalysisPhases["zones"], [&](std::size_t first, std::size_t count) {
        label_zones<Sample, Number>(domain.samples().subspan(first, count), paths, basin_to_zone.subspan(first, count),
                                    arrays.voxels.items());
    });
    arrays.zone = std::move(basin);
}

/// Critical elements, trees and, if asked for, zones. Cost: that of domain.critical(), O(n alpha), and of make_zones().
template <Domain D>
void analyse_domain(D& domain, bool zones, AnalysisArrays<typename D::Number>& arrays, const Context& context) {
    Criticals<typename D::Number> criticals = domain.critical(zones, context);
    report(context, kAnalysisPhases["trees"], 0);
    const ElementMeasures<typename D::Number> elements = make_trees(std::move(criticals.set), arrays, context);
    if (zones) {
        report(context, kAnalysisPhases["zones"], 0);
        make_zones(domain, std::move(criticals.basin), arrays, context);
    }
    make_measures(elements, arrays, context.threads);
    if (zones) report(context, kAnalysisPhases["zones"], 1);
}

}  // namespace isoatlas
