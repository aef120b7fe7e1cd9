#include <algorithm>

#include "census/brick_costs.h"
#include "isoatlas/atlas.h"
#include "isoatlas/environment.h"
#include "isoatlas/error.h"
#include "isoatlas/zone_files.h"

namespace isoatlas {
namespace {

double percent(std::int64_t part, std::int64_t whole) {
    return whole == 0 ? 0 : 100 * static_cast<double>(part) / static_cast<double>(whole);
}

/// So many numbers below count, at equal distances, the first and the last among them.
std::vector<std::size_t> evenly_chosen(std::size_t count, std::int64_t most) {
    std::vector<std::size_t> chosen;
    const std::size_t wanted = std::min(count, static_cast<std::size_t>(most));
    for (std::size_t i = 0; i < wanted; ++i) chosen.push_back(wanted == 1 ? count / 2 : i * (count - 1) / (wanted - 1));
    return chosen;
}

std::int64_t brick_bytes(const std::string& store, double tau, const Context& context) {
    const Atlas atlas(store);
    SurfaceOptions options;
    options.boundary = Boundary::open;
    options.normals = options.ids = false;
    (void)atlas.extract(tau, options, context);
    return atlas.reads().bytes;
}

}  // namespace

double ZoneFileRow::load_utility() const { return percent(cost.active, reads.cells_loaded); }
double ZoneFileRow::travel_utility() const { return percent(cost.active, reads.cells_visited); }

std::vector<ZoneFileRow> zone_file_table(ZoneFileSearch& file, const Volume& volume, const Analysis& analysis, std::int64_t most,
                                         const std::string& store, const Context& context) {
    const EnvironmentScope scope(context);
    if (most < 1) throw Error(ErrorKind::usage, {.what = std::to_string(most) + " isovalues", .expected = "at least one"});
    const std::vector<SearchCost> costs =
        file.layout() == ZoneLayout::by_zone ? search_costs(volume, analysis, context) : brick_costs(volume, analysis, context);
    std::vector<ZoneFileRow> rows;
    for (const std::size_t i : evenly_chosen(costs.size(), most)) {
        ZoneFileRow row;
        row.counted = costs[i];
        (void)file.active(costs[i].tau, row.cost);
        row.reads = file.reads();
        if (!store.empty()) row.brick_bytes = brick_bytes(store, costs[i].tau, context);
        rows.push_back(row);
    }
    return rows;
}

}  // namespace isoatlas
