#include "features/select_branches.h"

#include <algorithm>
#include <cmath>

#include "analysis/object_tree.h"
#include "base/memory_limit.h"
#include "base/paced_fill.h"

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
BigVector<double> branch_measures(const ObjectTree<Id>& tree, const BranchDecomposition& branches, const VolumeInfo& info) {
    BigVector<double> measure(branches.branch.size());
    const bool uniform = std::ranges::all_of(info.geometry.coordinates, [](const auto& c) { return c.size() < 2; });
    if (uniform) {
        const double one = voxel_measure(info.geometry, info.extent, 0);
        for (std::size_t i = 0; i < measure.size(); ++i) measure[i] = one * static_cast<double>(branches.branch[i].voxels);
        return measure;
    }
    BigVector<double> object = filled<double>(tree.size(), 0.0);
    for (std::size_t v = 0; v < tree.zone.size(); ++v)
        object[tree.zone[v]] += voxel_measure(info.geometry, info.extent, static_cast<std::int64_t>(v));
    for (std::size_t e = 0; e < tree.size(); ++e) {
        if (!tree.is_root(e)) object[tree.parent[e]] += object[e];
    }
    for (std::size_t i = 0; i < measure.size(); ++i) measure[i] = object[branches.branch[i].bottom];
    return measure;
}

std::vector<std::int64_t> select_branches(const BranchDecomposition& branches, std::span<const double> measure,
                                          const Selection& selection) {
    const BigVector<Branch>& all = branches.branch;
    const std::int64_t max = max_of(selection, static_cast<std::int64_t>(all.size()));
    const auto passes = [&](std::size_t i) {
        const Branch& b = all[i];
        return static_cast<std::int64_t>(i) < max && static_cast<double>(b.voxels) >= selection.min_voxels &&
               b.persistence >= selection.min_persistence && b.hypervolume >= selection.min_hypervolume &&
               (measure.empty() || measure[i] >= selection.min_measure);
    };
    std::vector<bool> keep(all.size());
    BudgetPoll memory;
    for (std::size_t i = 0; i < all.size(); ++i) keep[i] = i == 0 || passes(i), memory.step(sizeof(Branch) + sizeof(double));
    // Sums are rounded, so a branch may seem larger than the one it ends in: then neither is kept. Events of a parent have larger numbers.
    std::vector<std::int64_t> kept;
    for (std::size_t i = 0; i < all.size(); ++i) {
        bool is_kept = true;
        for (auto b = static_cast<std::int64_t>(i); is_kept && b >= 0; b = all[b].parent)
            is_kept = keep[b], memory.step(BudgetPoll::kTouch);
        if (is_kept) kept.push_back(static_cast<std::int64_t>(i));
    }
    return kept;
}

std::int64_t min_voxels(std::int64_t voxels) {
    return static_cast<std::int64_t>(std::clamp(static_cast<double>(voxels) / 2000, 1.0, 27.0));
}

double noise_height(double noise, std::int64_t voxels) { return 1.1 * std::sqrt(2 * std::log(static_cast<double>(voxels))) * noise; }

std::vector<std::int64_t> significant_branches(const BranchDecomposition& branches, std::int64_t voxels, const NoiseModel& noise,
                                               double sign) {
    const double hypervolumes = 2 * std::pow(static_cast<double>(voxels), 2.0 / 3);  // in standard deviations
    const std::int64_t min = min_voxels(voxels);
    std::vector<std::int64_t> kept{0};
    const BigVector<Branch>& all = branches.branch;
    BudgetPoll memory;
    for (std::size_t i = 1; i < all.size(); ++i) {
        memory.step(sizeof(Branch));
        const Branch& b = all[i];
        if (b.hypervolume < kRelativeSize * all[1].hypervolume) break;  // sorted by hypervolume
        const double sigma = noise.at(sign * b.merges);
        if ((b.persistence > noise_height(sigma, voxels) && b.voxels >= min) || b.hypervolume > hypervolumes * sigma)
            kept.push_back(static_cast<std::int64_t>(i));
    }
    return kept;
}

template BigVector<double> branch_measures(const ObjectTree<std::uint32_t>&, const BranchDecomposition&, const VolumeInfo&);
template BigVector<double> branch_measures(const ObjectTree<std::uint64_t>&, const BranchDecomposition&, const VolumeInfo&);

}  // namespace isoatlas
