// The table of dark objects, and their labels.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "field/order.h"
#include "isoatlas/active.h"
#include "isoatlas/dark_objects.h"
#include "zones/branch_rows.h"
#include "zones/dark_tree.h"
#include "zones/noise.h"
#include "zones/rank.h"

namespace isoatlas {
namespace {

void require_same_volume(const VolumeView& volume, const Analysis& analysis) {
    if (volume.info->extent != analysis.extent())
        throw Error(ErrorKind::usage, {.what = "the analysis is of another volume: the extents differ"});
}

/// Calls use(arrays, dark tree).
template <class Use>
auto with_dark_tree(const VolumeView& volume, const Analysis& analysis, const Context& context, const Use& use) {
    require_same_volume(volume, analysis);
    return analysis.data().visit([&]<class Id>(const IndexedArrays<Id>& held) {
        return visit_samples(volume, [&]<class T>(std::span<const T> samples) {
            return use(held.arrays, make_dark_tree(GridView<T>{samples.data(), volume.info->extent}, held.arrays, context));
        });
    });
}

/// Voxel of the lowest element of an event; -1: the outside.
template <class Id>
std::int64_t voxel_of(const AnalysisArrays<Id>& arrays, const DarkTree<Id>& dark, std::size_t event) {
    const std::size_t element = dark.element(event);
    return element == arrays.code.size() ? -1 : ElementCode{arrays.code[element]}.index();
}

template <class Id>
class DarkRanking {
public:
    DarkRanking(const VolumeView& volume, const AnalysisArrays<Id>& arrays, const DarkTree<Id>& dark)
        : volume_(volume), arrays_(arrays), dark_(dark), tree_(dark.side()), branches_(make_branches(tree_, sum_zones(tree_, volume_))) {}

    /// All but the outside.
    [[nodiscard]] DarkTable table(const RankOptions& options) const {
        DarkTable table;
        const NoiseModel noise = fit_noise(volume_);
        table.noise = noise.sigma;
        for (const Branch& b : branches_.branch) table.branches += b.parent >= 0 && b.appears > b.merges;
        RankOptions with_outside = options;
        with_outside.top = 0;
        if (with_outside.selection && with_outside.selection->keep) ++*with_outside.selection->keep;
        auto [rows, isovalues] = branch_rows(volume_, tree_, branches_, noise, with_outside);
        std::erase_if(rows, [](const BranchRow& row) { return row.branch == 0; });
        if (options.top > 0 && static_cast<std::int64_t>(rows.size()) > options.top) rows.resize(static_cast<std::size_t>(options.top));
        const std::vector<std::int64_t> around = closest_around(tree_, rows);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            table.entries.push_back(entry(rows[i], around[i]));
            table.entries.back().reason = std::ranges::find(isovalues, rows[i].branch, &BranchIsovalue::branch)->reason;  // it has one row
        }
        return first_entries(std::move(table), 0);
    }

private:
    [[nodiscard]] DarkEntry entry(const BranchRow& row, std::int64_t inside) const {
        DarkEntry entry{};
        entry.id = voxel_of(arrays_, dark_, branches_.highest[row.event]);
        entry.appears = -row.appears, entry.merges = -row.merges, entry.best_tau = -row.tau;
        entry.voxels = row.voxels, entry.measure = row.measure, entry.hypervolume = row.hypervolume;
        entry.islands = static_cast<std::int64_t>(dark_.contours[row.event]) - 1;
        entry.tau_low = -dark_.height[row.event];
        entry.tau_high = tree_.is_root(row.event) ? std::numeric_limits<double>::infinity() : -dark_.height[tree_.parent[row.event]];
        const std::array<std::int64_t, 3> voxel = volume_.info->extent.voxel(entry.id);
        for (std::size_t axis = 0; axis < 3; ++axis) entry.position[axis] = static_cast<double>(voxel[axis]);
        entry.inside = inside;
        return entry;
    }

    VolumeView volume_;
    const AnalysisArrays<Id>& arrays_;
    const DarkTree<Id>& dark_;
    SideTree<Id> tree_;
    Branches branches_;
};

/// The object around each, and the genus of the wall between them.
void add_walls(const Analysis& analysis, DarkTable& table) {
    const ActiveIndex index(analysis);
    for (DarkEntry& entry : table.entries) {
        const std::vector<ActiveContour> contours = index.at(entry.best_tau).contours;
        const auto wall = std::ranges::find_if(
            contours, [&](const ActiveContour& contour) { return contour.shell == Shell::inner && contour.id == entry.id; });
        if (wall == contours.end()) throw Error(ErrorKind::internal, {.what = "a cavity without a wall"});
        entry.object = wall->object;
        entry.tunnels = wall->genus;
    }
}

template <class Id>
std::vector<std::uint32_t> label(const VolumeView& volume, const AnalysisArrays<Id>& arrays, const DarkTree<Id>& dark, double tau,
                                 std::vector<std::int64_t>& ids) {
    const std::size_t events = dark.tree.size();
    // Parents before their children: the low component at tau that every Low event lies in.
    BigVector<Id> at(events), lowest(events);
    std::iota(lowest.begin(), lowest.end(), Id{0});
    for (std::size_t e = events; e-- > 0;) {
        at[e] = static_cast<Id>(e);
        if (!dark.tree.is_root(e) && -dark.height[dark.tree.parent[e]] < tau) at[e] = at[dark.tree.parent[e]];
    }
    BigVector<std::int64_t> voxels(events, std::int64_t{0});
    const auto for_lows = [&](auto&& visit) {
        visit_samples(volume, [&](auto samples) {
            for (std::size_t v = 0; v < samples.size(); ++v) {
                if (static_cast<double>(samples[v]) < tau) visit(v, at[dark.zone[v]]);
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
        const std::int64_t id = voxels[e] > 0 ? voxel_of(arrays, dark, lowest[e]) : -1;
        if (id >= 0) cavities.push_back({voxels[e], id, static_cast<Id>(e)});
    }
    std::ranges::sort(cavities, [](const Cavity& p, const Cavity& q) { return p.voxels != q.voxels ? p.voxels > q.voxels : p.id < q.id; });
    BigVector<std::uint32_t> number(events, std::uint32_t{0});
    ids.clear();
    for (const Cavity& cavity : cavities) ids.push_back(cavity.id), number[cavity.event] = static_cast<std::uint32_t>(ids.size());
    std::vector<std::uint32_t> labels(dark.zone.size(), 0);
    for_lows([&](std::size_t v, Id event) { labels[v] = number[event]; });
    return labels;
}

}  // namespace

DarkTable rank_dark_objects(const Volume& volume, const Analysis& analysis, const RankOptions& options, const Context& context) {
    return rank_dark_objects(VolumeView(volume), analysis, options, context);
}

DarkTable rank_dark_objects(const VolumeView& volume, const Analysis& analysis, const RankOptions& options, const Context& context) {
    DarkTable table = with_dark_tree(volume, analysis, context, [&]<class Id>(const AnalysisArrays<Id>& arrays, const DarkTree<Id>& dark) {
        return DarkRanking<Id>(volume, arrays, dark).table(options);
    });
    add_walls(analysis, table);
    return table;
}

std::vector<std::uint32_t> label_cavities(const Volume& volume, const Analysis& analysis, double tau, std::vector<std::int64_t>& ids,
                                          const Context& context) {
    if (!std::isfinite(tau))
        throw Error(ErrorKind::usage, {.what = "the isovalue is not a finite number", .next = "give a finite isovalue"});
    return with_dark_tree(volume, analysis, context, [&]<class Id>(const AnalysisArrays<Id>& arrays, const DarkTree<Id>& dark) {
        return label(volume, arrays, dark, tau, ids);
    });
}

}  // namespace isoatlas
