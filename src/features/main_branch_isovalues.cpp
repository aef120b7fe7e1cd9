#include "features/main_branch_isovalues.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace isoatlas {
namespace {

constexpr std::size_t kRows = 5;
constexpr double kPart = 0.05;       // of a joint object that makes a merge significant
constexpr double kGrown = 4.0 / 3;   // a volume that looks different
constexpr double kReproduced = 0.9;  // of the volume, in spite of noise
constexpr double kProminence = 1e3;  // instead of infinity

bool is_outline(const BranchIsovalue& isovalue) { return isovalue.reason == IsovalueReason::outline; }

/// Voxels of the object at a height, in between where bins are coarser.
double volume_at(const BranchHistogram& histogram, const std::vector<double>& volume, double height) {
    const double place = std::max(0.0, (histogram.axis.position(height) - histogram.low) / histogram.width());
    const auto bin = static_cast<std::size_t>(place);
    if (bin + 1 >= volume.size()) return 0;
    return std::lerp(volume[bin], volume[bin + 1], place - std::floor(place));
}

/// How much an isovalue adds to what is taken: all of its prominence where the object is at least e times as large or as small.
double gain(const BranchIsovalue& isovalue, const std::vector<BranchIsovalue>& taken) {
    double apart = 1;
    for (const BranchIsovalue& other : taken) apart = std::min(apart, std::abs(std::log(isovalue.volume / other.volume)));
    return std::min(isovalue.prominence, kProminence) * apart;
}

}  // namespace

std::vector<BranchIsovalue> before_merges(const BranchDecomposition& branches, const std::vector<BranchId>& significant,
                                          const BranchHistogram& histogram, const std::vector<BranchIsovalue>& own,
                                          const NoiseModel& noise) {
    std::vector<double> volume(histogram.added.size());
    std::partial_sum(histogram.added.rbegin(), histogram.added.rend(), volume.rbegin());
    std::vector<BranchIsovalue> all = own;
    for (const BranchId i : significant) {
        const Branch& other = branches.branch[i];
        const std::size_t bin = histogram.bin(other.merges) + 1;
        if (other.parent != kMainBranch || bin >= volume.size()) continue;
        const double tau = histogram.axis.height(histogram.low + static_cast<double>(bin) * histogram.width());
        const auto joining = static_cast<double>(other.voxels);
        if (joining < kPart * (volume[bin] + joining)) continue;
        double above = 0;  // the volume at the next isovalue
        for (const BranchIsovalue& isovalue : all) {
            if (isovalue.tau >= tau) above = std::max(above, isovalue.volume);
        }
        const bool has_grown = volume[bin] > kGrown * above;
        const bool is_reproduced = volume_at(histogram, volume, tau + noise.at(tau)) >= kReproduced * volume[bin];
        if (has_grown && is_reproduced) all.push_back({kMainBranch, tau, 0, IsovalueReason::merge, -1, volume[bin]});
    }
    return {all.begin() + static_cast<std::ptrdiff_t>(own.size()), all.end()};
}

std::size_t arrange_main_branch(std::vector<BranchIsovalue>& own, std::int64_t voxels) {
    std::vector<BranchIsovalue> outline, taken, left = own;
    if (is_outline(left.back())) outline.push_back(left.back()), left.pop_back();
    while (taken.size() + outline.size() < kRows && !left.empty()) {
        const auto best = std::ranges::max_element(
            left, {}, [&](const BranchIsovalue& isovalue) { return is_outline(isovalue) ? -1 : gain(isovalue, taken); });
        taken.push_back(*best);
        left.erase(best);
    }
    taken.insert(taken.end(), outline.begin(), outline.end());
    const auto is_box = [voxels](const BranchIsovalue& isovalue) {
        return is_outline(isovalue) && isovalue.volume > kBackgroundPart * static_cast<double>(voxels);
    };
    std::ranges::sort(taken,
                      [&](const BranchIsovalue& p, const BranchIsovalue& q) { return is_box(p) != is_box(q) ? is_box(q) : p.tau < q.tau; });
    const std::size_t rows = taken.size();
    taken.insert(taken.end(), left.begin(), left.end());
    own = std::move(taken);
    return rows;
}

}  // namespace isoatlas
