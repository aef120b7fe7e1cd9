#include "levelset/components.h"

#include <algorithm>
#include <limits>

#include "levelset/component_representatives.h"
#include "levelset/unite.h"

namespace isoatlas {
namespace {

/// Joins the Lows that touch the border of the volume: the outside, whose root is run 0.
void join_outside(RunSets& sets, const Runs& runs) {
    const std::int64_t ny = runs.extent.size[1], nz = runs.extent.size[2];
    for (std::int64_t r = 0; r < runs.rows(); ++r) {
        const RunRow row = runs.row(r);
        const std::int64_t y = r % ny, z = r / ny;
        const bool border_row = y == 0 || y == ny - 1 || (runs.extent.rank == 3 && (z == 0 || z == nz - 1));
        const std::int64_t last = border_row ? row.changes : std::min<std::int64_t>(row.changes, 1);
        for (std::int64_t i = 0; i < last; i += 2) sets.join(0, row.first_run + i);
    }
    sets.join(0, runs.count() - 1);
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
    join_outside(sets, runs);
    components.of_run.resize(static_cast<std::size_t>(runs.count()));
    components.of_run.front() = components.of_run.back() = 0;
    components.outer_object.push_back(-1);
    for (std::int64_t r = 0; r < runs.rows(); ++r) {
        const RunRow row = runs.row(r);
        for (std::int64_t i = 0; i < row.changes; ++i) {
            const std::int64_t run = row.first_run + i, root = sets.find(run);
            if (root == run && run != 0) {
                std::vector<std::int32_t>& outer = i & 1 ? components.outer_low : components.outer_object;
                outer.push_back(towards_outside(components, r, i));
                ISOATLAS_CHECK(outer.size() < std::size_t{std::numeric_limits<std::int32_t>::max()});
                components.of_run[run] = static_cast<std::int32_t>(outer.size() - 1);
            }
            components.of_run[run] = components.of_run[root];
        }
    }
}

}  // namespace

Components find_components(const TauLevel& level, double tunnel_height, const Context& context) {
    Components components{find_runs(level.high, context), {}, {}, {}, {}, {}};
    RunSets sets = unite_runs(level.volume, level.tau, tunnel_height, level.high, components.runs, context);
    number_components(sets, components);
    find_representatives(level, context, components);
    return components;
}

}  // namespace isoatlas
