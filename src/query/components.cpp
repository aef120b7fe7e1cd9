#include "query/components.h"

#include <limits>

#include "query/names.h"
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

}  // namespace

Components find_components(const TauLevel& level, double tunnel_height, const Context& context) {
    Components components{find_runs(level.high, context), {}, {}, {}, {}, {}};
    RunSets sets = unite_runs(level.volume, level.tau, tunnel_height, level.high, components.runs, context);
    number_components(sets, components);
    name_components(level, context, components);
    return components;
}

}  // namespace isoatlas
