#include "zones/branch_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "zones/select_branches.h"
#include "zones/stable_isovalue.h"

namespace isoatlas {
namespace {

constexpr std::size_t kBins = 256;
constexpr std::size_t kTrunkRows = 5;  // nested zones of the trunk: skin, skull, enamel, ...

/// Counts of voxels by height along one branch. Integer samples with a small range get one bin a value, cut half way between values.
struct BranchHistogram {
    double low, high;
    std::vector<double> added;

    BranchHistogram(double from, double to, bool integer) : low(from), high(to), added(kBins, 0) {
        if (!integer || to - from > static_cast<double>(kBins)) return;
        low += 0.5, high += 0.5;
        added.assign(static_cast<std::size_t>(std::max(1.0, to - from)), 0);
    }
    void add(double value, double count) {
        const double range = high - low;  // 0: a constant volume
        const double bin = range > 0 && std::isfinite(range) ? (value - low) / range * static_cast<double>(added.size()) : 0;
        added[static_cast<std::size_t>(std::clamp(bin, 0.0, static_cast<double>(added.size() - 1)))] += count;
    }
};

template <class Id>
class Rows {
public:
    Rows(const VolumeView& volume, const SideTree<Id>& tree, const Branches& branches)
        : volume_(volume), tree_(tree), branches_(branches) {}

    [[nodiscard]] std::vector<BranchRow> choose(const NoiseModel& noise, const RankOptions& options) const {
        std::vector<BranchRow> rows = choose_isovalues(chosen(noise, options));
        if (options.top > 0 && static_cast<std::int64_t>(rows.size()) > options.top) rows.resize(static_cast<std::size_t>(options.top));
        measure(rows);
        return rows;
    }

private:
    [[nodiscard]] bool is_bright() const { return tree_.sign > 0; }
    [[nodiscard]] double lowest() const { return branches_.lowest; }

    /// By rank; more than there may be rows are not needed.
    [[nodiscard]] std::vector<std::int64_t> chosen(const NoiseModel& noise, const RankOptions& options) const {
        std::vector<std::int64_t> kept;
        if (options.selection) {
            const bool measured = options.selection->least_measure > 0;
            const BigVector<double> measure = measured ? branch_measures(tree_, branches_, volume_) : BigVector<double>();
            kept = select_branches(branches_, measure, *options.selection);
        } else if (options.gate) {
            kept = essential_branches(branches_, volume_.info->extent.voxels(), noise, tree_.sign);
        } else {
            kept.resize(branches_.branch.size());
            std::iota(kept.begin(), kept.end(), std::int64_t{0});
        }
        if (options.top > 0 && static_cast<std::int64_t>(kept.size()) > options.top + 1)
            kept.resize(static_cast<std::size_t>(options.top) + 1);
        return kept;
    }

    /// Histograms along the kept branches: own voxels by height, whole merged branches at the height where they merge.
    [[nodiscard]] std::vector<BranchHistogram> histograms(const std::vector<std::int64_t>& kept) const {
        const bool integer = !is_floating(volume_.info->type);
        BigVector<std::int64_t> slot(branches_.branch.size(), std::int64_t{-1});
        std::vector<BranchHistogram> result;
        for (std::size_t k = 0; k < kept.size(); ++k) {
            const Branch& b = branches_.branch[kept[k]];
            slot[kept[k]] = static_cast<std::int64_t>(k);
            result.emplace_back(std::max(b.merges, lowest()), b.appears, integer);
        }
        tree_.for_heights(volume_, [&](std::size_t v, double height) {
            const std::int64_t k = slot[branches_.of_event[tree_.zone[v]]];
            if (k >= 0) result[k].add(height, 1);
        });
        for (std::size_t i = 1; i < branches_.branch.size(); ++i) {
            const Branch& b = branches_.branch[i];
            const std::int64_t k = slot[b.parent];
            if (k >= 0) result[k].add(b.merges, static_cast<double>(b.voxels));
        }
        return result;
    }

    [[nodiscard]] std::vector<BranchRow> choose_isovalues(const std::vector<std::int64_t>& kept) const {
        const std::vector<BranchHistogram> histogram = histograms(kept);
        std::vector<BranchRow> rows;
        for (std::size_t k = 0; k < kept.size(); ++k) {
            const Branch& b = branches_.branch[kept[k]];
            std::vector<StableIsovalue> peaks = stable_isovalues(histogram[k].added, histogram[k].low, histogram[k].high);
            std::stable_partition(peaks.begin(), peaks.end(), [](const StableIsovalue& peak) { return !peak.outline; });
            if (peaks.empty()) peaks.push_back({just_above(b, histogram[k]), 0, false});
            peaks.resize(std::min<std::size_t>(peaks.size(), k == 0 ? kTrunkRows : 1));
            for (const StableIsovalue& peak : peaks)
                rows.push_back({kept[k], b.appears, b.merges, alive(peak.tau, b), b.hypervolume, peak.outline});
        }
        return rows;
    }

    /// The closest isovalue at which the branch is there. A sample is High when its value is at least tau, Low when it is below: a bright
    /// branch lives in (merges, appears], a dark one in [merges, appears) as heights go.
    [[nodiscard]] double alive(double tau, const Branch& b) const {
        const double end = std::max(b.merges, lowest());
        if (is_bright()) return std::clamp(tau, std::nextafter(end, b.appears), b.appears);
        return std::clamp(tau, end, std::nextafter(b.appears, end));
    }

    /// No isovalue stands out: one bin above the height at which the branch ends, the middle of the range for the trunk.
    [[nodiscard]] double just_above(const Branch& b, const BranchHistogram& histogram) const {
        const double width = (histogram.high - histogram.low) / static_cast<double>(histogram.added.size());
        return b.merges < lowest() ? (lowest() + b.appears) / 2 : histogram.low + std::min(width, (b.appears - histogram.low) / 2);
    }

    /// Does a sample of a height belong to the object of its branch at tau?
    [[nodiscard]] bool belongs(double height, double tau) const { return is_bright() ? height >= tau : height > tau; }

    /// The event of every row, and the voxels of its object at tau.
    void measure(std::vector<BranchRow>& rows) const {
        const Extent& extent = volume_.info->extent;
        const bool uniform = std::all_of(volume_.info->geometry.coordinates.begin(), volume_.info->geometry.coordinates.end(),
                                         [](const auto& c) { return c.size() < 2; });
        std::vector<bool> wanted(tree_.size(), false);
        std::multimap<std::int64_t, BranchRow*> of_event;
        for (BranchRow& row : rows) {
            row.event = branches_.branch[row.branch].top;
            while (!tree_.is_root(row.event) && belongs(tree_.height[tree_.parent[row.event]], row.tau))
                row.event = tree_.parent[row.event];
            row.voxels = branches_.objects.voxels[row.event] - static_cast<std::int64_t>(tree_.voxels[row.event]);  // of its children
            wanted[row.event] = true;
            of_event.emplace(row.event, &row);
        }
        tree_.for_heights(volume_, [&](std::size_t v, double height) {
            if (!wanted[tree_.zone[v]]) return;
            const auto [begin, end] = of_event.equal_range(static_cast<std::int64_t>(tree_.zone[v]));
            for (auto i = begin; i != end; ++i) i->second->voxels += belongs(height, i->second->tau);
        });
        for (BranchRow& row : rows) {
            row.measure =
                uniform ? static_cast<double>(row.voxels) * voxel_measure(volume_.info->geometry, extent, 0) : rectilinear_measure(row);
        }
    }

    /// Sum of voxel boxes of the object of a row; one pass, on rectilinear grids only.
    [[nodiscard]] double rectilinear_measure(const BranchRow& row) const {
        std::vector<bool> inside(tree_.size(), false);  // children have smaller numbers: parents first
        for (std::size_t e = static_cast<std::size_t>(row.event) + 1; e-- > 0;) {
            inside[e] = static_cast<std::int64_t>(e) == row.event || (!tree_.is_root(e) && inside[tree_.parent[e]]);
        }
        double sum = 0;
        tree_.for_heights(volume_, [&](std::size_t v, double height) {
            if (inside[tree_.zone[v]] && belongs(height, row.tau))
                sum += voxel_measure(volume_.info->geometry, volume_.info->extent, static_cast<std::int64_t>(v));
        });
        return sum;
    }

    const VolumeView& volume_;
    const SideTree<Id>& tree_;
    const Branches& branches_;
};

template <class Id>
bool contains(const SideTree<Id>& tree, std::int64_t outer, std::int64_t inner) {
    while (inner < outer && !tree.is_root(inner)) inner = tree.parent[inner];
    return inner == outer;
}

}  // namespace

template <class Id>
std::vector<BranchRow> branch_rows(const VolumeView& volume, const SideTree<Id>& tree, const Branches& branches, const NoiseModel& noise,
                                   const RankOptions& options) {
    return Rows<Id>(volume, tree, branches).choose(noise, options);
}

template <class Id>
std::vector<std::int64_t> closest_around(const SideTree<Id>& tree, const std::vector<BranchRow>& rows) {
    std::vector<std::int64_t> around(rows.size(), -1);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        for (std::size_t j = 0; j < rows.size(); ++j) {
            if (!(rows[j].tau < rows[i].tau)) continue;
            if (around[i] >= 0 && rows[j].tau <= rows[around[i]].tau) continue;
            if (contains(tree, rows[j].event, rows[i].event)) around[i] = static_cast<std::int64_t>(j);
        }
    }
    return around;
}

#define ISOATLAS_BRANCH_ROWS(Id)                                                                                            \
    template std::vector<BranchRow> branch_rows(const VolumeView&, const SideTree<Id>&, const Branches&, const NoiseModel&, \
                                                const RankOptions&);                                                        \
    template std::vector<std::int64_t> closest_around(const SideTree<Id>&, const std::vector<BranchRow>&);
ISOATLAS_BRANCH_ROWS(std::uint32_t)
ISOATLAS_BRANCH_ROWS(std::uint64_t)
#undef ISOATLAS_BRANCH_ROWS

}  // namespace isoatlas
