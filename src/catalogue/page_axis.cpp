#include "catalogue/page_axis.h"

namespace isoatlas {

AxisScale page_axis(const Atlas& atlas, const Context& context) {
    const auto [low, high] = atlas.range();
    const std::vector<double> edges = axis_edges(low, high);
    return axis_scale(low, high, edges.empty() ? std::vector<std::int64_t>() : atlas.histogram(edges, context));
}

}  // namespace isoatlas
