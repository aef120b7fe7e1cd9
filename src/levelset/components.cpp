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
        for (std::int64_t i = 0; i < last; i += 2) sets.join(0, row.run(i).number());
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
    const RunId run = row.run_at(runs.row(r).change[i - 1]);
    ISOATLAS_CHECK(row.is_high(run) != ((i & 1) != 0));
    return components.of_run[run];
}

/// Adds the component whose first run in scan order is run i of row r. Returns its number.
std::int32_t add_component(Components& components, std::int64_t r, std::int64_t i) {
    const bool is_high = (i & 1) != 0;
    const std::int32_t outer = towards_outside(components, r, i);
    if (is_high)
        components.outer_low.push_back(LowNumber(outer));
    else
        components.outer_object.push_back(ObjectNumber(outer));
    const std::size_t count = is_high ? components.outer_low.size() : components.outer_object.size();
    ISOATLAS_CHECK(count < std::size_t{std::numeric_limits<std::int32_t>::max()});
    return static_cast<std::int32_t>(count - 1);
}

void number_components(RunSets& sets, Components& components) {
    const Runs& runs = components.runs;
    join_outside(sets, runs);
    IdArray<RunId, std::int32_t>& of_run = components.of_run;
    of_run.items().resize(static_cast<std::size_t>(runs.count()));  // the outside has the first run and the last one
    of_run.items().front() = of_run.items().back() = 0;
    components.outer_object.push_back(ObjectNumber::none());
    for (std::int64_t r = 0; r < runs.rows(); ++r) {
        const RunRow row = runs.row(r);
        for (std::int64_t i = 0; i < row.changes; ++i) {
            const RunId run = row.run(i), root(sets.find(run.number()));
            const bool is_new = root == run && run != RunId(0);
            of_run[run] = is_new ? add_component(components, r, i) : of_run[root];
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
