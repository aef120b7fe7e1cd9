#include "analysis/sublevel_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "analysis/trees.h"
#include "base/bit_ranks.h"
#include "base/check.h"
#include "base/memory_limit.h"
#include "base/paced_fill.h"
#include "base/phase.h"
#include "base/sample_types.h"
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
template <class Id>
CriticalityTree<Id> sublevel_events(const AnalysisArrays<Id>& arrays, std::span<const double> height, int rank) {
    const std::size_t n = arrays.value.size();
    const SplitTree<Id> low = split_tree_of(arrays.contours);
    const BigVector<LevelKind> kinds =
        level_kinds<Id>(arrays.contours, arrays.level, arrays.value, rank == 3 ? delta_chis(arrays.code, 3) : BigVector<std::int8_t>());
    BigVector<Id> join(n + 1), level(n + 1);
    BigVector<LevelKind> kind(n + 1);
    level[0] = 0, kind[0] = LevelKind::minimum;
    BudgetPoll memory;
    for (std::size_t x = 0; x <= n; ++x) {
        memory.step(128);
        join[n - x] = low.parent[x] == static_cast<Id>(x) ? static_cast<Id>(n + 1) : static_cast<Id>(n - low.parent[x]);
        if (x == n) continue;
        level[n - x] = static_cast<Id>(n - arrays.level[x]);
        kind[n - x] = kinds[x];
    }
    return criticality_tree<Id>(join_groups<Id>(join, height), join, level, kind);
}

/// A contour begins to surround its low component at its lower end and ceases at its upper one.
template <class Id>
BigVector<Id> count_contours(const ContourTree<Id>& contours, const CriticalityTree<Id>& tree) {
    const std::size_t n = contours.nodes() - 1;
    BigVector<Id> count = filled<Id>(tree.size(), Id{0});
    BudgetPoll memory;
    for (std::size_t x = 0; x <= n; ++x) {
        memory.step(BudgetPoll::kTouch);
        count[tree.event_of_element[n - x]] += static_cast<Id>(contours.above(x) - contours.below(x));  // wraps around and back
    }
    for (std::size_t e = 0; e < tree.size(); ++e) {
        memory.step(BudgetPoll::kTouch);
        if (!tree.is_root(e)) count[tree.parent[e]] += count[e];
    }
    return count;
}

/// Per number of a minimum (critical/basins.h; 0 is the outside): its element, numbered backwards.
template <class Id>
BigVector<Id> elements_of_minima(std::span<const std::uint64_t> code, const Extent& extent) {
    BitRanks minima(static_cast<std::size_t>(extent.voxels()));
    const auto for_minima = [&](auto&& visit) {
        BudgetPoll memory;
        for (std::size_t i = 0; i < code.size(); ++i) {
            memory.step(BudgetPoll::kTouch / 4);
            if (const ElementCode element{code[i]}; element.l0() == 0) visit(static_cast<std::size_t>(element.index()), code.size() - i);
        }
    };
    for_minima([&](std::size_t voxel, std::size_t) { minima.add(voxel); });
    BigVector<Id> elements(minima.count() + 1);
    elements[0] = 0;
    for_minima([&](std::size_t voxel, std::size_t element) { elements[minima.rank(voxel) + 1] = static_cast<Id>(element); });
    return elements;
}

/// Basins of minima: how many lie before each slab is counted from the links.
template <class Id>
BigVector<Id> basins_of_minima(const Extent& extent, std::span<const std::uint8_t> links, const Context& context) {
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
    return resolve_basins<Id>(extent, height, Direction::down, links, first, context.threads);
}

/// Basins in sublevel.zone become zones in place.
template <class T, class Id>
void label_zones(const GridView<T>& grid, const HeavyPathDecomposition<Id, ComparisonValue<T>>& paths, SublevelTree<Id>& sublevel,
                 const Context& context) {
    using Value = ComparisonValue<T>;
    const std::int64_t slice = grid.extent.slice();
    for_each_slab(context, only_phase("sublevel zones"), {grid.extent.size[2], slice}, [&](const Slab& slab) {
        std::vector<Value> height(kBlock);
        std::vector<Id> minimum(kBlock);
        std::vector<std::uint32_t> scratch(kBlock);
        const auto end = static_cast<std::size_t>(slab.z_end * slice);
        for (auto first = static_cast<std::size_t>(slab.z_begin * slice); first < end; first += kBlock) {
            const std::size_t count = std::min(kBlock, end - first);
            for (std::size_t i = 0; i < count; ++i) {
                height[i] = -static_cast<Value>(grid.samples[first + i]);
                minimum[i] = Basins<Id>::number(sublevel.zone[first + i]);
            }
            paths.zones({height.data(), count}, {minimum.data(), count}, scratch, std::span<Id>(sublevel.zone).subspan(first, count));
        }
    });
    fill_fresh(sublevel.voxels, sublevel.tree.size(), Id{0});
    BudgetPoll memory;
    for (const Id zone : sublevel.zone) {
        memory.step(BudgetPoll::kTouch / 4);  // zones of neighbours are often the same
        ++sublevel.voxels[zone];
    }
}

}  // namespace

template <class T, class Id>
SublevelTree<Id> make_sublevel_tree(const GridView<T>& grid, const AnalysisArrays<Id>& arrays, const Context& context) {
    const std::size_t n = arrays.value.size();
    const T lowest = *std::min_element(grid.samples, grid.samples + grid.extent.voxels());
    BigVector<double> height(n + 1);
    height[0] = -std::nextafter(static_cast<double>(lowest), -std::numeric_limits<double>::infinity());
    BudgetPoll memory;
    for (std::size_t x = 0; x < n; ++x) height[n - x] = -arrays.value[x], memory.step();
    SublevelTree<Id> sublevel;
    sublevel.tree = sublevel_events(arrays, height, grid.extent.rank);
    ISOATLAS_DCHECK(every_event_has_its_zone<Id>(sublevel.tree, height));
    sublevel.contours = count_contours(arrays.contours, sublevel.tree);
    sublevel.height.resize(sublevel.tree.size());
    for (std::size_t e = 0; e < sublevel.tree.size(); ++e) {
        memory.step(BudgetPoll::kTouch);
        sublevel.height[e] = height[sublevel.tree.top[e]];
    }
    const BigVector<Id> minima = elements_of_minima<Id>(arrays.code, grid.extent);
    const HeavyPathDecomposition<Id, ComparisonValue<T>> paths(
        {sublevel.tree.parent, height, sublevel.tree.top, sublevel.tree.event_of_element}, minima, context.threads);
    sublevel.zone = basins_of_minima<Id>(grid.extent, links_of_grid(grid, context), context);
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
