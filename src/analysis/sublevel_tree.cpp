#include "analysis/sublevel_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "analysis/trees.h"
#include "base/bit_ranks.h"
#include "base/check.h"
#include "base/paced_fill.h"
#include "base/phase.h"
#include "base/sample_types.h"
#include "base/streamed.h"
#include "critical/domain.h"
#include "critical/elements_with_extrema.h"
#include "critical/grid_scan.h"
#include "critical/links.h"
#include "field/order.h"
#include "field/slab_work.h"
#include "tree/heavy_paths.h"
#include "tree/predicates.h"
#include "tree/split_tree.h"

namespace isoatlas {
namespace {

constexpr std::size_t kBlock = 1024;  // samples whose zones are found together

/// Events of the split tree, with the elements numbered backwards.
template <class Number>
CriticalityTree<Number> sublevel_events(const AnalysisArrays<Number>& arrays, ByElementView<Number, double> height, int rank) {
    const std::size_t n = arrays.value.size();
    const SplitTree<Number> low = split_tree_of(arrays.contours);
    const ByElement<Number, LevelKind> kinds = level_kinds<Number>(
        arrays.contours, arrays.level, arrays.value, rank == 3 ? delta_chis(arrays.code, 3) : ByElement<Number, std::int8_t>());
    const auto backwards = [n](ElementIdOf<Number> x) { return ElementIdOf<Number>(n - x.index()); };
    MergeTree<Number> join(n + 1);
    ByElement<Number, ElementIdOf<Number>> level(n + 1);
    ByElement<Number, LevelKind> kind(n + 1);
    level[ElementIdOf<Number>(0)] = ElementIdOf<Number>(0), kind[ElementIdOf<Number>(0)] = LevelKind::minimum;
    for (const auto x : streamed<ElementIdOf<Number>>(n + 1, in_order(16))) {
        join[backwards(x)] = low.parent[x] == x ? ElementIdOf<Number>(n + 1) : backwards(low.parent[x]);
        if (x.index() == n) continue;
        level[backwards(x)] = backwards(arrays.level[x]);
        kind[backwards(x)] = kinds[x];
    }
    return criticality_tree<Number>(join_groups<Number>(join, height), join, level, kind);
}

/// A contour begins to surround its low component at its lower end and ceases at its upper one.
template <class Number>
ByEvent<Number, Number> count_contours(const ContourTree<Number>& contours, const CriticalityTree<Number>& tree) {
    const std::size_t n = contours.nodes() - 1;
    ByEvent<Number, Number> count(filled(tree.size(), Number{0}));
    for (const auto x : streamed<ElementIdOf<Number>>(n + 1, at_random())) {
        const EventIdOf<Number> e = tree.event_of_element[ElementIdOf<Number>(n - x.index())];
        count[e] += static_cast<Number>(contours.above(x) - contours.below(x));  // wraps around and back
    }
    for (const auto e : streamed<EventIdOf<Number>>(tree.size(), at_random())) {
        if (!tree.is_root(e)) count[tree.parent[e]] += count[e];
    }
    return count;
}

/// Per minimum (critical/basins.h; 0 is the outside): its element, numbered backwards. As maxima: they are those of the values negated.
template <class Number>
ElementsOfMaxima<Number> elements_of_minima(const ByElement<Number, std::uint64_t>& code, const Extent& extent) {
    using Minimum = MaximumIdOf<Number>;
    BitRanks minima(static_cast<std::size_t>(extent.voxels()));
    const auto for_minima = [&](auto&& visit) {
        for (const auto i : streamed<ElementIdOf<Number>>(code.size(), at_random_one_in(4))) {
            if (const ElementCode element{code[i]}; element.l0() == 0) {
                visit(static_cast<std::size_t>(element.index()), ElementIdOf<Number>(code.size() - i.index()));
            }
        }
    };
    for_minima([&](std::size_t voxel, ElementIdOf<Number>) { minima.add(voxel); });
    ElementsOfMaxima<Number> elements(minima.count() + 1);
    elements[Minimum(0)] = ElementIdOf<Number>(0);
    for_minima([&](std::size_t voxel, ElementIdOf<Number> element) { elements[Minimum(minima.rank(voxel) + 1)] = element; });
    return elements;
}

/// Basins of minima: how many lie before each slab is counted from the links.
template <class Number>
BigVector<Number> basins_of_minima(const Extent& extent, std::span<const std::uint8_t> links, const Context& context) {
    const std::int64_t height = slab_height(extent, context), slice = extent.slice();
    std::vector<std::int64_t> first;
    std::int64_t count = 0;
    for (std::int64_t begin = 0; begin < extent.size[2]; begin += height) {
        first.push_back(count);
        for (std::int64_t v = begin * slice; v < std::min(begin + height, extent.size[2]) * slice; ++v) {
            const VertexType& type = kVertexTypes[static_cast<std::size_t>(extent.rank)][links[v]];
            count += type.critical && type.l0 == 0;
        }
    }
    return resolve_basins<Number>(extent, height, Direction::down, links, first, context.threads);
}

/// Basins in sublevel.zone become zones in place.
template <class T, class Number>
void label_zones(const GridView<T>& grid, const HeavyPathDecomposition<Number, ComparisonValue<T>>& paths, SublevelTree<Number>& sublevel,
                 const Context& context) {
    using Value = ComparisonValue<T>;
    const std::int64_t slice = grid.extent.slice();
    const std::span<Number> zone = sublevel.zone.items();
    for_each_slab(context, only_phase("sublevel zones"), {grid.extent.size[2], slice}, [&](const Slab& slab) {
        std::vector<Value> height(kBlock);
        std::vector<Number> minimum(kBlock);
        std::vector<std::uint32_t> scratch(kBlock);
        const auto end = static_cast<std::size_t>(slab.z_end * slice);
        for (auto first = static_cast<std::size_t>(slab.z_begin * slice); first < end; first += kBlock) {
            const std::size_t count = std::min(kBlock, end - first);
            for (std::size_t i = 0; i < count; ++i) {
                height[i] = -static_cast<Value>(grid.samples[first + i]);
                minimum[i] = Basins<Number>::number(zone[first + i]);
            }
            paths.zones({height.data(), count}, {minimum.data(), count}, scratch, zone.subspan(first, count));
        }
    });
    fill_fresh(sublevel.voxels.items(), sublevel.tree.size(), Number{0});
    // Zones of neighbours are often the same.
    for (const std::size_t v : streamed(zone.size(), at_random_one_in(4))) ++sublevel.voxels[EventIdOf<Number>(zone[v])];
}

}  // namespace

template <class T, class Number>
SublevelTree<Number> make_sublevel_tree(const GridView<T>& grid, const AnalysisArrays<Number>& arrays, const Context& context) {
    const std::size_t n = arrays.value.size();
    const T lowest = *std::min_element(grid.samples, grid.samples + grid.extent.voxels());
    ByElement<Number, double> height(n + 1);
    height[ElementIdOf<Number>(0)] = -std::nextafter(static_cast<double>(lowest), -std::numeric_limits<double>::infinity());
    for (const auto x : streamed<ElementIdOf<Number>>(n, in_order(8))) height[ElementIdOf<Number>(n - x.index())] = -arrays.value[x];
    SublevelTree<Number> sublevel;
    sublevel.tree = sublevel_events<Number>(arrays, height, grid.extent.rank);
    ISOATLAS_DCHECK(every_event_has_its_zone<Number>(sublevel.tree, height));
    sublevel.contours = count_contours(arrays.contours, sublevel.tree);
    sublevel.height.items().resize(sublevel.tree.size());
    for (const auto e : streamed<EventIdOf<Number>>(sublevel.tree.size(), at_random())) sublevel.height[e] = height[sublevel.tree.top[e]];
    const ElementsOfMaxima<Number> minima = elements_of_minima<Number>(arrays.code, grid.extent);
    const HeavyPathDecomposition<Number, ComparisonValue<T>> paths(
        {sublevel.tree.parent, height, sublevel.tree.top, sublevel.tree.event_of_element}, minima, context.threads);
    sublevel.zone = ByVoxel<Number, Number>(basins_of_minima<Number>(grid.extent, links_of_grid(grid, context), context));
    label_zones(grid, paths, sublevel, context);
    return sublevel;
}

// NOLINTBEGIN(bugprone-macro-parentheses): T is a type
#define ISOATLAS_DARK(T)                                                                                                               \
    template SublevelTree<std::uint32_t> make_sublevel_tree(const GridView<T>&, const AnalysisArrays<std::uint32_t>&, const Context&); \
    template SublevelTree<std::uint64_t> make_sublevel_tree(const GridView<T>&, const AnalysisArrays<std::uint64_t>&, const Context&);
ISOATLAS_FOR_SAMPLE_TYPES(ISOATLAS_DARK)
#undef ISOATLAS_DARK
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace isoatlas
