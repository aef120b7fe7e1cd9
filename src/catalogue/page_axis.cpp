#include "catalogue/page_axis.h"

#include "atlas/access.h"
#include "census/level_census.h"

namespace isoatlas {

std::vector<Bounds> samples_of_at_least(const Atlas& atlas, std::span<const double> values) {
    const LevelCensus& census = AtlasAccess::census(atlas);
    const bool whole = !is_floating(atlas.info().type);
    std::vector<Bounds> bounds;
    for (const double value : values) bounds.push_back(census.at(value, whole).samples);
    return bounds;
}

AxisScale page_axis(const Atlas& atlas, const Context& context) {
    const auto [low, high] = atlas.range();
    const std::vector<double> edges = axis_edges(low, high);
    if (const std::optional<AxisScale> scale = axis_scale(low, high, samples_of_at_least(atlas, edges))) return *scale;
    return axis_scale(low, high, atlas.histogram(edges, context));
}

}  // namespace isoatlas
