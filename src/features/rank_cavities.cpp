// The table of cavities, and their labels.
#include <algorithm>
#include <limits>
#include <numeric>

#include "base/streamed.h"
#include "features/cavity_candidates.h"
#include "features/noise.h"
#include "features/rank.h"
#include "field/order.h"
#include "field/require_isovalue.h"
#include "isoatlas/active.h"
#include "isoatlas/cavities.h"
#include "isoatlas/environment.h"

namespace isoatlas {
namespace {

void require_same_volume(const VolumeView& volume, const Analysis& analysis) {
    if (volume.info->extent != analysis.extent())
        throw Error(ErrorKind::usage, {.what = "the analysis is of another volume: the extents differ"});
}

template <class Id>
CavityEntry entry_of(const VolumeView& volume, const AnalysisArrays<Id>& arrays, const CavityCandidates<Id>& side, const Candidate& row) {
    CavityEntry entry{};
    entry.id = side.voxel(arrays, row.event);
    entry.branch_minimum = lowest_voxel(arrays, side.sublevel, side.branches.branch[row.branch].top);
    entry.appears = -row.appears, entry.merges = -row.merges, entry.best_tau = -row.tau;
    entry.reason = std::ranges::find(side.chosen.isovalues, row.branch, &BranchIsovalue::branch)->reason;  // it has one row
    entry.voxels = row.voxels, entry.measure = row.measure, entry.hypervolume = row.hypervolume;
    entry.islands = static_cast<std::int64_t>(side.sublevel.contours[row.event]) - 1;
    entry.tau_low = -side.tree.height[row.event];
    entry.tau_high =
        side.tree.is_root(row.event) ? std::numeric_limits<double>::infinity() : -side.tree.height[side.tree.parent(row.event)];
    const Index3 voxel = volume.info->extent.voxel(entry.id);
    for (std::size_t axis = 0; axis < 3; ++axis) entry.position[axis] = static_cast<double>(voxel[axis]);
    return entry;
}

/// Every isovalue of a branch, with the cavity that it is there.
template <class Id>
void add_isovalues(const AnalysisArrays<Id>& arrays, const CavityCandidates<Id>& side, CavityTable& table) {
    for (const BranchIsovalue& own : side.chosen.isovalues) {
        const EventId top = side.branches.branch[own.branch].top;
        EventId event = top;
        while (!side.tree.is_root(event) && side.tree.height[side.tree.parent(event)] > own.tau) event = side.tree.parent(event);
        const std::int64_t minimum = lowest_voxel(arrays, side.sublevel, top);
        table.isovalues.push_back({minimum, -own.tau, own.prominence, own.reason, side.voxel(arrays, event)});
    }
}

/// The object around each, and the genus of the wall between them.
void add_walls(const Analysis& analysis, CavityTable& table) {
    const ActiveIndex index(analysis);
    for (CavityEntry& entry : table.entries) {
        const std::vector<ActiveContour> contours = index.at(entry.best_tau).contours;
        const auto wall = std::ranges::find_if(
            contours, [&](const ActiveContour& contour) { return contour.shell == Shell::inner && contour.id == entry.id; });
        if (wall == contours.end()) throw Error(ErrorKind::internal, {.what = "a cavity without a wall"});
        entry.object = wall->object;
        entry.tunnels = wall->genus;
    }
}

template <class Id>
std::vector<std::uint32_t> label(const VolumeView& volume, const AnalysisArrays<Id>& arrays, const SublevelTree<Id>& sublevel, double tau,
                                 std::vector<std::int64_t>& ids) {
    const ObjectTree<Id> tree = sublevel.side();
    const std::size_t events = tree.size();
    // Parents before their children: the low component at tau that every Low event lies in.
    BigVector<Id> at(events), lowest(events);
    std::iota(lowest.begin(), lowest.end(), Id{0});
    for (std::size_t e = events; e-- > 0;) {
        at[e] = static_cast<Id>(e);
        const EventId event(e);
        if (!tree.is_root(event) && -tree.height[tree.parent(event)] < tau) at[e] = at[tree.parent(event).index()];
    }
    BigVector<std::int64_t> voxels(events, std::int64_t{0});
    const auto for_lows = [&](auto&& visit) {
        visit_samples(volume, [&](auto samples) {
            for (std::size_t v = 0; v < samples.size(); ++v) {
                if (static_cast<double>(samples[v]) < tau) visit(v, at[tree.zones[VoxelId(v)]]);
            }
        });
    };
    for_lows([&](std::size_t, Id event) { ++voxels[event]; });
    for (std::size_t e = 0; e < events; ++e) lowest[at[e]] = std::min(lowest[at[e]], lowest[e]);
    struct Cavity {
        std::int64_t voxels, id;
        Id event;
    };
    std::vector<Cavity> cavities;
    for (std::size_t e = 0; e < events; ++e) {
        const std::int64_t id = voxels[e] > 0 ? lowest_voxel(arrays, sublevel, EventId(lowest[e])) : -1;
        if (id >= 0) cavities.push_back({voxels[e], id, static_cast<Id>(e)});
    }
    std::ranges::sort(cavities, [](const Cavity& p, const Cavity& q) { return p.voxels != q.voxels ? p.voxels > q.voxels : p.id < q.id; });
    BigVector<std::uint32_t> number(events, std::uint32_t{0});
    ids.clear();
    for (const Cavity& cavity : cavities) ids.push_back(cavity.id), number[cavity.event] = static_cast<std::uint32_t>(ids.size());
    std::vector<std::uint32_t> labels(sublevel.zone.size(), 0);
    for_lows([&](std::size_t v, Id event) { labels[v] = number[event]; });
    return labels;
}

}  // namespace

template <class Id>
CavityTable cavity_table(const VolumeView& volume, const Analysis& analysis, const AnalysisArrays<Id>& arrays,
                         const CavityCandidates<Id>& side, const NoiseModel& noise, std::int64_t top) {
    CavityTable table;
    table.noise = noise.sigma;
    for (const BranchId i : streamed<BranchId>(side.branches.branch.size(), {sizeof(Branch)})) {
        const Branch& b = side.branches.branch[i];
        table.branches += b.parent.exists() && b.appears > b.merges;
    }
    std::vector<Candidate> rows = side.chosen.rows;
    if (top > 0 && static_cast<std::int64_t>(rows.size()) > top) rows.resize(static_cast<std::size_t>(top));
    const std::vector<std::int64_t> around = closest_around(side.tree, rows);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        table.entries.push_back(entry_of(volume, arrays, side, rows[i]));
        table.entries.back().inside = around[i];
    }
    add_isovalues(arrays, side, table);
    table = first_entries(std::move(table), 0);
    add_walls(analysis, table);
    return table;
}

template CavityTable cavity_table(const VolumeView&, const Analysis&, const AnalysisArrays<std::uint32_t>&,
                                  const CavityCandidates<std::uint32_t>&, const NoiseModel&, std::int64_t);
template CavityTable cavity_table(const VolumeView&, const Analysis&, const AnalysisArrays<std::uint64_t>&,
                                  const CavityCandidates<std::uint64_t>&, const NoiseModel&, std::int64_t);

CavityTable rank_cavities(const Volume& volume, const Analysis& analysis, const RankOptions& options, const Context& context) {
    const EnvironmentScope scope(context);
    return rank_cavities(VolumeView(volume), analysis, options, context);
}

CavityTable rank_cavities(const VolumeView& volume, const Analysis& analysis, const RankOptions& options, const Context& context) {
    require_same_volume(volume, analysis);
    const NoiseModel noise = fit_noise(volume);
    return analysis.data().visit([&](const auto& held) {
        return cavity_table(volume, analysis, held.arrays, make_cavity_candidates(volume, held.arrays, noise, options, context), noise,
                            options.top);
    });
}

std::vector<std::uint32_t> label_cavities(const Volume& volume, const Analysis& analysis, double tau, std::vector<std::int64_t>& ids,
                                          const Context& context) {
    const EnvironmentScope scope(context);
    require_isovalue(tau);
    require_same_volume(volume, analysis);
    return analysis.data().visit([&](const auto& held) {
        return label(volume, held.arrays, make_sublevel_tree(VolumeView(volume), held.arrays, context), tau, ids);
    });
}

}  // namespace isoatlas
