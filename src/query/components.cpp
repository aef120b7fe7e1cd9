#include "query/components.h"

#include <limits>

#include "query/slab_work.h"
#include "query/unite.h"

namespace isoatlas {
namespace {

/// Calls visit(run number) for the runs of Lows that touch the border of the volume.
template <class Visit>
void for_border_lows(const Runs& runs, Visit&& visit) {
    const std::int64_t ny = runs.extent.size[1], nz = runs.extent.size[2];
    for (std::int64_t r = 0; r < runs.rows(); ++r) {
        const RunRow row = runs.row(r);
        const std::int64_t y = r % ny, z = r / ny;
        const bool border_row = y == 0 || y == ny - 1 || (runs.extent.rank == 3 && (z == 0 || z == nz - 1));
        const std::int64_t step = border_row ? 2 : std::max<std::int64_t>(row.changes, 1);  // all Lows, or the first and the last run
        for (std::int64_t i = 0; i < row.runs(); i += step) visit(row.first_run + i);
    }
}

/// The component that lies before run i of row r along the last axis, next to its first position. Both ends of that grid edge differ in
/// class. The first run of a component in scan order has nothing of it further down this axis: from there a ray leaves the volume without
/// meeting the component again, so what lies there is the component towards the outside.
std::int32_t towards_outside(const Components& components, std::int64_t r, std::int64_t i) {
    const Runs& runs = components.runs;
    const std::int64_t below = runs.extent.rank == 3 ? r - runs.extent.size[1] : r - 1;
    if (below < 0) return 0;
    const RunRow row = runs.row(below);
    const std::int64_t run = row.run_at(runs.row(r).change[i - 1]);
    ISOATLAS_CHECK(((run - row.first_run) & 1) != (i & 1));
    return components.of_run[run];
}

void number_components(RunSets& sets, Components& components) {
    const Runs& runs = components.runs;
    components.of_run.assign(static_cast<std::size_t>(runs.count()), -1);
    for_border_lows(runs, [&](std::int64_t run) { components.of_run[sets.find(run)] = 0; });
    components.outer_object.push_back(-1);
    for (std::int64_t r = 0; r < runs.rows(); ++r) {
        const RunRow row = runs.row(r);
        for (std::int64_t i = 0; i < row.runs(); ++i) {
            const std::int64_t run = row.first_run + i, root = sets.find(run);
            if (components.of_run[root] == -1) {
                ISOATLAS_CHECK(root == run);
                std::vector<std::int32_t>& outer = i & 1 ? components.outer_low : components.outer_object;
                outer.push_back(towards_outside(components, r, i));
                ISOATLAS_CHECK(outer.size() < std::size_t{std::numeric_limits<std::int32_t>::max()});
                components.of_run[run] = static_cast<std::int32_t>(outer.size() - 1);
            }
            components.of_run[run] = components.of_run[root];
        }
    }
}

/// Position of the highest sample of a run of Highs (the last one), of the lowest of a run of Lows (the first one).
template <class T>
std::int64_t extreme_of(const T* row, std::int64_t begin, std::int64_t end, bool high) {
    std::int64_t best = begin;
    if (high) {
        for (std::int64_t x = begin + 1; x < end; ++x) best = row[x] >= row[best] ? x : best;
    } else {
        for (std::int64_t x = begin + 1; x < end; ++x) best = row[x] < row[best] ? x : best;
    }
    return best;
}

/// Keeps the more extreme voxel of a component.
template <class T>
void offer(const T* samples, bool high, std::int64_t voxel, std::int64_t& best) {
    if (best == -1 || (high ? samples[voxel] >= samples[best] : samples[voxel] < samples[best])) best = voxel;
}

template <class T>
void find_extremes(const GridView<T>& grid, const Context& context, Components& components) {
    const Runs& runs = components.runs;
    const std::int64_t ny = grid.extent.size[1];
    std::vector<std::uint32_t> extreme(static_cast<std::size_t>(runs.count()));
    const auto for_runs = [&](std::int64_t r, auto&& visit) {  // not those of the outside: nobody asks
        const RunRow row = runs.row(r);
        for (std::int64_t i = 1; i < row.changes; ++i) {
            const bool high = i & 1;
            if (high || components.of_run[row.first_run + i] != 0) visit(row, i, high);
        }
    };
    for_each_row(context, {"objects", 1, 3}, grid.extent, [&](std::int64_t y, std::int64_t z) {
        for_runs(y + ny * z, [&](const RunRow& row, std::int64_t i, bool high) {
            const std::int64_t begin = row.change[i - 1] - 1, end = row.change[i] - 1;
            extreme[row.first_run + i] = static_cast<std::uint32_t>(extreme_of(grid.row(y, z), begin, end, high));
        });
    });
    for (std::int64_t r = 0; r < runs.rows(); ++r) {
        for_runs(r, [&](const RunRow& row, std::int64_t i, bool high) {
            const std::int64_t voxel = r * grid.extent.size[0] + extreme[row.first_run + i];
            const std::int32_t component = components.of_run[row.first_run + i];
            offer(grid.samples, high, voxel, high ? components.highest[component] : components.lowest[component]);
        });
    }
}

/// The highest voxel of an object is a maximum, the lowest one of a low component a minimum: the first of a sorted list that it contains.
void take_extremes(const Extrema& extrema, Components& components) {
    const Extent& extent = components.runs.extent;
    const auto take = [&](const std::vector<std::int64_t>& voxels, bool high, std::vector<std::int64_t>& name) {
        for (const std::int64_t voxel : voxels) {
            const std::array<std::int64_t, 3> at = extent.voxel(voxel);
            const RunRow row = components.runs.row(at[1], at[2]);
            const std::int64_t run = row.run_at(at[0] + 1);
            ISOATLAS_CHECK(((run - row.first_run) & 1) == (high ? 1 : 0));
            std::int64_t& named = name[components.of_run[run]];
            if (named == -1) named = voxel;
        }
    };
    take(extrema.maxima, true, components.highest);
    take(extrema.minima, false, components.lowest);
    components.lowest[0] = -1;  // the outside has no name
}

}  // namespace

Components find_components(const TauLevel& level, double tunnel_height, const Context& context) {
    Components components{find_runs(level.high, context), {}, {}, {}, {}, {}};
    RunSets sets = unite_runs(level.volume, level.tau, tunnel_height, level.high, components.runs, context);
    number_components(sets, components);
    components.highest.assign(static_cast<std::size_t>(components.objects()), -1);
    components.lowest.assign(static_cast<std::size_t>(components.lows()), -1);
    if (level.extrema != nullptr) {
        take_extremes(*level.extrema, components);
        return components;
    }
    visit_samples(level.volume, [&](auto samples) {
        using T = typename decltype(samples)::value_type;
        find_extremes(GridView<T>{samples.data(), level.info().extent}, context, components);
    });
    return components;
}

}  // namespace isoatlas
