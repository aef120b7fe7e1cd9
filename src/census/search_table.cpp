#include "isoatlas/search_table.h"

#include <algorithm>
#include <limits>

#include "bricks/brick_surroundings.h"
#include "census/brick_costs.h"
#include "census/interval_counts.h"
#include "census/zone_files.h"
#include "field/brick_grid.h"
#include "field/slab_work.h"
#include "isoatlas/environment.h"
#include "levelset/volume_cells.h"

namespace isoatlas {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

/// The middles of the intervals in which zones do not change, ascending.
std::vector<double> isovalues_of(const Volume& volume, const Analysis& analysis) {
    std::vector<double> ends;
    for (const EventId e : ids<EventId>(analysis.event_count())) ends.push_back(analysis.event(e).value);
    visit_samples(volume, [&](auto samples) { ends.push_back(static_cast<double>(*std::ranges::min_element(samples))); });
    std::ranges::sort(ends);
    ends.erase(std::ranges::unique(ends).begin(), ends.end());
    std::vector<double> isovalues;
    for (std::size_t i = 1; i < ends.size(); ++i) {
        const double middle = ends[i - 1] / 2 + ends[i] / 2;
        isovalues.push_back(middle > ends[i - 1] && middle <= ends[i] ? middle : ends[i]);  // neighbours may have nothing between them
    }
    return isovalues;
}

std::vector<std::int64_t> count_active(const Volume& volume, std::span<const double> isovalues, const Context& context) {
    const Extent& extent = volume.info.extent;
    IntervalCounts active(isovalues);
    for_each_slab(context, kSearchPhases["active cells"], {extent.size[2], extent.slice()}, [&](const Slab& slab) {
        for (std::int64_t z = slab.z_begin; z < slab.z_end; ++z) {
            for_cells_of_slice(extent, z, [&](std::span<const std::int64_t> corners) {
                double low = kUnbounded, high = -kUnbounded;
                for (const std::int64_t voxel : corners) {
                    const double value = volume.value(voxel);
                    low = std::min(low, value), high = std::max(high, value);
                }
                active.add(low, high);
            });
        }
    });
    return active.counts();
}

/// Cells whose first corner lies in a box.
std::int64_t cells_in(const Box& box, const Extent& extent) {
    std::int64_t cells = 1;
    for (int axis = 0; axis < extent.rank; ++axis) cells *= std::min(box.end[axis], extent.size[axis] - 1) - box.begin[axis];
    return std::max<std::int64_t>(cells, 0);
}

struct BrickCounts {
    std::vector<std::int64_t> cells, bricks;  ///< per isovalue: loaded; read
};

/// A brick is read at isovalues in (low, high]: range of its samples and its halo, -infinity outside the volume.
void count_brick(const Volume& volume, const Box& box, IntervalCounts& loaded, IntervalCounts& read) {
    const Extent& extent = volume.info.extent;
    Box seen = box;
    double low = kUnbounded, high = -kUnbounded;
    for (int axis = 0; axis < extent.rank; ++axis) {
        seen.begin[axis] -= kSurroundings, seen.end[axis] += kSurroundings;
        if (seen.begin[axis] < 0 || seen.end[axis] > extent.size[axis]) low = -kUnbounded;
        seen.begin[axis] = std::max<std::int64_t>(seen.begin[axis], 0);
        seen.end[axis] = std::min(seen.end[axis], extent.size[axis]);
    }
    for (std::int64_t z = seen.begin[2]; z < seen.end[2]; ++z) {
        for (std::int64_t y = seen.begin[1]; y < seen.end[1]; ++y) {
            const RowPart part = surroundings(box, y, z);
            for (std::int64_t x = std::max(part.begin, seen.begin[0]); x < std::min(part.end, seen.end[0]); ++x) {
                const double value = volume.value(extent.index(x, y, z));
                low = std::min(low, value), high = std::max(high, value);
            }
        }
    }
    loaded.add(low, high, cells_in(box, extent));
    read.add(low, high);
}

BrickCounts count_bricks(const Volume& volume, std::span<const double> isovalues, const Context& context) {
    const BrickGrid grid(volume.info.extent);
    IntervalCounts loaded(isovalues), read(isovalues);
    for_each_slab(context, kSearchPhases["active cells"], {grid.size[2], grid.size[0] * grid.size[1]}, [&](const Slab& slab) {
        for (std::int64_t z = slab.z_begin; z < slab.z_end; ++z) {
            for (const BrickId b : grid.bricks_of_layer(z)) count_brick(volume, grid.box(b), loaded, read);
        }
    });
    return {loaded.counts(), read.counts()};
}

/// Of number(i) for i in [0, count).
template <class Number>
Spread spread_of(std::size_t count, const Number& number) {
    if (count == 0) return {};
    Spread spread{-kUnbounded, 0, kUnbounded};
    for (std::size_t i = 0; i < count; ++i) {
        const auto n = static_cast<double>(number(i));
        spread = {std::max(spread.max, n), spread.average + n, std::min(spread.min, n)};
    }
    spread.average /= static_cast<double>(count);
    return spread;
}

double percent(std::int64_t part, std::int64_t whole) {
    return whole == 0 ? 0 : 100 * static_cast<double>(part) / static_cast<double>(whole);
}

SearchWay way_of(const std::vector<SearchCost>& costs, std::int64_t SearchCost::* loaded, std::int64_t SearchCost::* visited,
                 std::int64_t cells) {
    const std::size_t n = costs.size();
    return {spread_of(n, [&](std::size_t i) { return costs[i].*visited; }), spread_of(n, [&](std::size_t i) { return costs[i].*loaded; }),
            spread_of(n, [&](std::size_t i) { return percent(costs[i].active, costs[i].*loaded); }),
            spread_of(n, [&](std::size_t i) { return percent(costs[i].active, costs[i].*visited); }),
            spread_of(n, [&](std::size_t i) { return percent(costs[i].*loaded, cells); })};
}

struct Counted {
    std::vector<SearchCost> costs;
    std::vector<std::int64_t> zone_points;
};

Counted count_all(const Volume& volume, const Analysis& analysis, const Context& context) {
    Counted counted{brick_costs(volume, analysis, context), {}};
    std::vector<double> isovalues;
    for (const SearchCost& cost : counted.costs) isovalues.push_back(cost.tau);
    ZoneFiles files = count_zone_files(volume, analysis, isovalues, context);
    for (std::size_t i = 0; i < isovalues.size(); ++i)
        counted.costs[i].zones_loaded = files.loaded[i], counted.costs[i].zones_visited = files.visited[i];
    counted.zone_points = std::move(files.points);
    return counted;
}

}  // namespace

std::vector<SearchCost> brick_costs(const Volume& volume, const Analysis& analysis, const Context& context) {
    const std::vector<double> isovalues = isovalues_of(volume, analysis);
    const std::vector<std::int64_t> active = count_active(volume, isovalues, context);
    const BrickCounts bricks = count_bricks(volume, isovalues, context);
    std::vector<SearchCost> costs;
    for (std::size_t i = 0; i < isovalues.size(); ++i) costs.push_back({isovalues[i], active[i], 0, 0, bricks.cells[i], bricks.bricks[i]});
    return costs;
}

std::vector<SearchCost> search_costs(const Volume& volume, const Analysis& analysis, const Context& context) {
    const EnvironmentScope scope(context);
    return count_all(volume, analysis, context).costs;
}

SearchTable search_table(const Volume& volume, const Analysis& analysis, const Context& context) {
    const EnvironmentScope scope(context);
    const Counted counted = count_all(volume, analysis, context);
    const std::vector<SearchCost>& costs = counted.costs;
    SearchTable table;
    table.cells = cell_count(volume.info.extent);
    table.zones = analysis.event_count();
    table.isovalues = static_cast<std::int64_t>(costs.size());
    table.zone_points = spread_of(counted.zone_points.size(), [&](std::size_t i) { return counted.zone_points[i]; });
    table.active = spread_of(costs.size(), [&](std::size_t i) { return costs[i].active; });
    table.active_percent = spread_of(costs.size(), [&](std::size_t i) { return percent(costs[i].active, table.cells); });
    table.zone_files = way_of(costs, &SearchCost::zones_loaded, &SearchCost::zones_visited, table.cells);
    table.bricks = way_of(costs, &SearchCost::bricks_loaded, &SearchCost::bricks_loaded, table.cells);
    return table;
}

}  // namespace isoatlas
