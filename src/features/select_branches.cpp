#include "features/select_branches.h"

#include <algorithm>
#include <cmath>

#include "analysis/object_tree.h"
#include "base/paced_fill.h"
#include "base/streamed.h"

namespace isoatlas {
namespace {

constexpr double kRelativeSize = 0.003;  // of the largest hypervolume that is not the main branch's

/// How many of all branches may be kept by their rank.
std::int64_t max_of(const Selection& selection, std::int64_t branches) {
    std::int64_t max = branches;
    if (selection.keep) max = std::min(max, *selection.keep);
    if (selection.top_percent) {
        const double part = std::ceil(*selection.top_percent / 100 * static_cast<double>(branches));
        max = std::min(max, static_cast<std::int64_t>(std::clamp(part, 0.0, static_cast<double>(branches))));
    }
    return max;
}

}  // namespace

template <class Id>
IdArray<BranchId, double> branch_measures(const ObjectTree<Id>& tree, const BranchDecomposition& branches, const VolumeInfo& info) {
    IdArray<BranchId, double> measure(branches.branch.size());
    const bool uniform = std::ranges::all_of(info.geometry.coordinates, [](const auto& c) { return c.size() < 2; });
    if (uniform) {
        const double one = voxel_measure(info.geometry, info.extent, 0);
        for (const BranchId i : measure.ids()) measure[i] = one * static_cast<double>(branches.branch[i].voxels);
        return measure;
    }
    IdArray<EventId, double> object(filled(tree.size(), 0.0));
    for (const VoxelId v : tree.zones.ids()) object[tree.zone(v)] += voxel_measure(info.geometry, info.extent, v.number());
    for (const EventId e : object.ids()) {
        if (!tree.is_root(e)) object[tree.parent(e)] += object[e];
    }
    for (const BranchId i : measure.ids()) measure[i] = object[branches.branch[i].bottom];
    return measure;
}

std::vector<BranchId> select_branches(const BranchDecomposition& branches, IdSpan<BranchId, const double> measure,
                                      const Selection& selection) {
    const IdArray<BranchId, Branch>& all = branches.branch;
    const std::int64_t max = max_of(selection, static_cast<std::int64_t>(all.size()));
    const auto passes = [&](BranchId i) {
        const Branch& b = all[i];
        return i < BranchId(max) && static_cast<double>(b.voxels) >= selection.min_voxels && b.persistence >= selection.min_persistence &&
               b.hypervolume >= selection.min_hypervolume && (measure.empty() || measure[i] >= selection.min_measure);
    };
    std::vector<bool> keep(all.size());
    for (const BranchId i : streamed<BranchId>(all.size(), {sizeof(Branch) + sizeof(double)}))
        keep[i.index()] = i == kMainBranch || passes(i);
    // Sums are rounded, so a branch may seem larger than the one it ends in: then neither is kept. Events of a parent have larger numbers.
    std::vector<BranchId> kept;
    StreamedPaths around(at_random());
    const auto next = [&](BranchId b) { return keep[b.index()] ? all[b].parent : BranchId::none(); };
    for (const BranchId i : all.ids()) {
        bool is_kept = true;
        for (const BranchId b : around.from(i, next)) is_kept = keep[b.index()];
        if (is_kept) kept.push_back(i);
    }
    return kept;
}

std::int64_t min_voxels(std::int64_t voxels) {
    return static_cast<std::int64_t>(std::clamp(static_cast<double>(voxels) / 2000, 1.0, 27.0));
}

double noise_height(double noise, std::int64_t voxels) { return 1.1 * std::sqrt(2 * std::log(static_cast<double>(voxels))) * noise; }

std::vector<BranchId> significant_branches(const BranchDecomposition& branches, std::int64_t voxels, const NoiseModel& noise, double sign) {
    const double hypervolumes = 2 * std::pow(static_cast<double>(voxels), 2.0 / 3);  // in standard deviations
    const std::int64_t min = min_voxels(voxels);
    std::vector<BranchId> kept{kMainBranch};
    const IdArray<BranchId, Branch>& all = branches.branch;
    for (const BranchId i : streamed<BranchId>(all.size(), {sizeof(Branch)})) {
        if (i == kMainBranch) continue;
        const Branch& b = all[i];
        if (b.hypervolume < kRelativeSize * all[kMainBranch.next()].hypervolume) break;  // sorted by hypervolume
        const double sigma = noise.at(sign * b.merges);
        if ((b.persistence > noise_height(sigma, voxels) && b.voxels >= min) || b.hypervolume > hypervolumes * sigma) kept.push_back(i);
    }
    return kept;
}

template IdArray<BranchId, double> branch_measures(const ObjectTree<std::uint32_t>&, const BranchDecomposition&, const VolumeInfo&);
template IdArray<BranchId, double> branch_measures(const ObjectTree<std::uint64_t>&, const BranchDecomposition&, const VolumeInfo&);

}  // namespace isoatlas
