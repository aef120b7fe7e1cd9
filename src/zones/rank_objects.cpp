// The table of essential objects: gate, isovalues, sizes (essential.md sections 0 to 3).
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "field/order.h"
#include "isoatlas/objects.h"
#include "zones/analysis_data.h"
#include "zones/branches.h"
#include "zones/noise.h"
#include "zones/rank.h"
#include "zones/stable_isovalue.h"

namespace isoatlas {
namespace {

constexpr std::size_t kBins = 256;
constexpr std::size_t kTrunkEntries = 5;  // nested zones of the trunk: skin, skull, enamel, ...
constexpr double kRelativeSize = 0.003;   // of the largest hypervolume that is not the trunk's

/// One row in the making: a branch and one isovalue on it.
struct Row {
    std::int64_t branch;
    double appears, merges, tau, hypervolume;
    bool outline;
    std::int64_t event = 0;
    std::int64_t voxels = 0;
    double measure = 0;
};

/// Counts of voxels by isovalue along one branch. Integer samples with a small range get one bin a value, cut half way between values.
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
class Ranking {
public:
    Ranking(const VolumeView& volume, const AnalysisArrays<Id>& arrays, bool is_3d) : volume_(volume), arrays_(arrays), is_3d_(is_3d) {
        BigVector<double> sum(arrays.tree.size(), 0.0);
        lowest_ = std::numeric_limits<double>::infinity();
        visit_samples(volume, [&](auto samples) {
            for (std::size_t v = 0; v < samples.size(); ++v) {
                const auto value = static_cast<double>(samples[v]);
                sum[arrays.zone[v]] += value;
                lowest_ = std::min(lowest_, value);
            }
        });
        branches_ = make_branches(arrays, sum, lowest_);
    }

    [[nodiscard]] ObjectTable table(const RankOptions& options) {
        ObjectTable table;
        table.noise = estimate_noise(volume_);
        for (const Branch& b : branches_.branch) table.branches += b.appears > b.merges;
        std::vector<std::int64_t> kept = essential(table.noise, options);
        std::vector<Row> rows = choose_isovalues(kept);
        if (options.top > 0 && static_cast<std::int64_t>(rows.size()) > options.top) rows.resize(static_cast<std::size_t>(options.top));
        measure(rows);
        for (const Row& row : rows) table.entries.push_back(entry(row, rows));
        return first_entries(std::move(table), 0);
    }

private:
    [[nodiscard]] double value_of(std::int64_t event) const { return arrays_.value[arrays_.tree.top[event]]; }

    /// Branches that noise does not explain and that are not tiny beside the largest; the trunk first.
    [[nodiscard]] std::vector<std::int64_t> essential(double noise, const RankOptions& options) const {
        const auto n = static_cast<double>(volume_.info->extent.voxels());
        const double least_height = 1.1 * noise * std::sqrt(2 * std::log(n)), least_hypervolume = 2 * noise * std::pow(n, 2.0 / 3);
        const auto least_voxels = static_cast<std::int64_t>(std::clamp(n / 2000, 1.0, 27.0));
        std::vector<std::int64_t> kept{0};
        const BigVector<Branch>& all = branches_.branch;
        for (std::size_t i = 1; i < all.size(); ++i) {
            const Branch& b = all[i];
            if (options.gate && b.hypervolume < kRelativeSize * all[1].hypervolume) break;  // sorted by hypervolume
            const bool beyond_noise = (b.height > least_height && b.voxels >= least_voxels) || b.hypervolume > least_hypervolume;
            if (!options.gate || beyond_noise) kept.push_back(static_cast<std::int64_t>(i));
            if (options.top > 0 && static_cast<std::int64_t>(kept.size()) > options.top) break;
        }
        return kept;
    }

    /// Histograms along the kept branches: own voxels by value, whole merged branches at the value where they merge.
    [[nodiscard]] std::vector<BranchHistogram> histograms(const std::vector<std::int64_t>& kept) const {
        const bool integer = !is_floating(volume_.info->type);
        BigVector<std::int64_t> slot(branches_.branch.size(), std::int64_t{-1});
        std::vector<BranchHistogram> result;
        for (std::size_t k = 0; k < kept.size(); ++k) {
            const Branch& b = branches_.branch[kept[k]];
            slot[kept[k]] = static_cast<std::int64_t>(k);
            result.emplace_back(std::max(b.merges, lowest_), b.appears, integer);
        }
        visit_samples(volume_, [&](auto samples) {
            for (std::size_t v = 0; v < samples.size(); ++v) {
                const std::int64_t k = slot[branches_.of_event[arrays_.zone[v]]];
                if (k >= 0) result[k].add(static_cast<double>(samples[v]), 1);
            }
        });
        for (std::size_t i = 1; i < branches_.branch.size(); ++i) {
            const Branch& b = branches_.branch[i];
            const std::int64_t k = slot[branches_.of_event[arrays_.tree.parent[b.bottom]]];
            if (k >= 0) result[k].add(b.merges, static_cast<double>(b.voxels));
        }
        return result;
    }

    [[nodiscard]] std::vector<Row> choose_isovalues(const std::vector<std::int64_t>& kept) const {
        const std::vector<BranchHistogram> histogram = histograms(kept);
        std::vector<Row> rows;
        for (std::size_t k = 0; k < kept.size(); ++k) {
            const Branch& b = branches_.branch[kept[k]];
            std::vector<StableIsovalue> peaks = stable_isovalues(histogram[k].added, histogram[k].low, histogram[k].high);
            std::stable_partition(peaks.begin(), peaks.end(), [](const StableIsovalue& peak) { return !peak.outline; });
            if (peaks.empty()) peaks.push_back({just_above(b, histogram[k]), 0, false});
            peaks.resize(std::min<std::size_t>(peaks.size(), k == 0 ? kTrunkEntries : 1));
            for (const StableIsovalue& peak : peaks) {
                const double tau = std::clamp(peak.tau, std::nextafter(std::max(b.merges, lowest_), b.appears), b.appears);
                rows.push_back({kept[k], b.appears, b.merges, tau, b.hypervolume, peak.outline});
            }
        }
        return rows;
    }

    /// No isovalue stands out: one bin above the value at which the branch ends, the middle of the range for the trunk.
    [[nodiscard]] double just_above(const Branch& b, const BranchHistogram& histogram) const {
        const double width = (histogram.high - histogram.low) / static_cast<double>(histogram.added.size());
        return b.merges < lowest_ ? (lowest_ + b.appears) / 2 : histogram.low + std::min(width, (b.appears - histogram.low) / 2);
    }

    /// The event of every row, and the voxels of its object at tau.
    void measure(std::vector<Row>& rows) const {
        const Extent& extent = volume_.info->extent;
        const bool uniform = std::all_of(volume_.info->geometry.coordinates.begin(), volume_.info->geometry.coordinates.end(),
                                         [](const auto& c) { return c.size() < 2; });
        std::vector<bool> wanted(arrays_.tree.size(), false);
        std::multimap<std::int64_t, Row*> of_event;
        for (Row& row : rows) {
            row.event = branches_.branch[row.branch].top;
            while (!arrays_.tree.is_root(row.event) && value_of(arrays_.tree.parent[row.event]) >= row.tau)
                row.event = arrays_.tree.parent[row.event];
            row.voxels = branches_.objects.voxels[row.event] - static_cast<std::int64_t>(arrays_.voxels[row.event]);  // of its children
            wanted[row.event] = true;
            of_event.emplace(row.event, &row);
        }
        visit_samples(volume_, [&](auto samples) {
            for (std::size_t v = 0; v < samples.size(); ++v) {
                if (!wanted[arrays_.zone[v]]) continue;
                const auto [begin, end] = of_event.equal_range(static_cast<std::int64_t>(arrays_.zone[v]));
                for (auto i = begin; i != end; ++i) i->second->voxels += static_cast<double>(samples[v]) >= i->second->tau;
            }
        });
        for (Row& row : rows) {
            row.measure =
                uniform ? static_cast<double>(row.voxels) * voxel_measure(volume_.info->geometry, extent, 0) : rectilinear_measure(row);
        }
    }

    /// Sum of voxel boxes of the object of a row; one pass, on rectilinear grids only.
    [[nodiscard]] double rectilinear_measure(const Row& row) const {
        std::vector<bool> inside(arrays_.tree.size(), false);  // children have smaller numbers: parents first
        for (std::size_t e = static_cast<std::size_t>(row.event) + 1; e-- > 0;) {
            inside[e] = static_cast<std::int64_t>(e) == row.event || (!arrays_.tree.is_root(e) && inside[arrays_.tree.parent[e]]);
        }
        double sum = 0;
        visit_samples(volume_, [&](auto samples) {
            for (std::size_t v = 0; v < samples.size(); ++v) {
                if (inside[arrays_.zone[v]] && static_cast<double>(samples[v]) >= row.tau)
                    sum += voxel_measure(volume_.info->geometry, volume_.info->extent, static_cast<std::int64_t>(v));
            }
        });
        return sum;
    }

    [[nodiscard]] ObjectEntry entry(const Row& row, const std::vector<Row>& rows) const {
        const std::int64_t peak = arrays_.tree.top[branches_.highest[row.event]];
        const ElementCode code{arrays_.code[peak]};
        ObjectEntry entry{};
        entry.id = code.index();  // the highest element of an object is a maximum: a voxel
        entry.event = row.event;
        entry.appears = row.appears, entry.merges = row.merges, entry.best_tau = row.tau;
        entry.voxels = row.voxels, entry.measure = row.measure, entry.hypervolume = row.hypervolume;
        const auto contours = static_cast<std::int64_t>(arrays_.measures.contours[row.event]);
        entry.cavities = is_3d_ ? contours - 1 : 0;
        entry.tunnels = 1 + entry.cavities - static_cast<std::int64_t>(arrays_.measures.chi[row.event]);
        entry.position = element_position(code, volume_.info->extent);
        const bool root = arrays_.tree.is_root(row.event);
        entry.tau_low = root ? -std::numeric_limits<double>::infinity() : value_of(arrays_.tree.parent[row.event]);
        entry.tau_high = value_of(row.event);
        entry.inside = closest_around(row, rows);
        entry.branch_top = branches_.branch[row.branch].top;
        entry.outline = row.outline;
        entry.trunk = row.branch == 0;
        return entry;
    }

    /// The closest other row that contains this one: on the way down from its event, the first with a row of a lower isovalue.
    [[nodiscard]] std::int64_t closest_around(const Row& row, const std::vector<Row>& rows) const {
        std::int64_t closest = -1;
        for (std::size_t j = 0; j < rows.size(); ++j) {
            if (!(rows[j].tau < row.tau)) continue;
            if (closest >= 0 && rows[j].tau <= rows[closest].tau) continue;
            if (contains(rows[j].event, row.event)) closest = static_cast<std::int64_t>(j);
        }
        return closest;
    }

    [[nodiscard]] bool contains(std::int64_t outer, std::int64_t inner) const {
        while (inner < outer && !arrays_.tree.is_root(inner)) inner = arrays_.tree.parent[inner];
        return inner == outer;
    }

    const VolumeView volume_;
    const AnalysisArrays<Id>& arrays_;
    bool is_3d_;
    double lowest_ = 0;
    Branches branches_;
};

}  // namespace

ObjectTable rank_objects(const VolumeView& volume, const Analysis& analysis, const RankOptions& options) {
    if (volume.info->extent != analysis.extent())
        throw Error(ErrorKind::usage, {.what = "the analysis is of another volume: the extents differ"});
    return analysis.data().visit([&](const auto& held) {
        if (held.arrays.zone.empty()) throw Error(ErrorKind::usage, {.what = "ranking objects needs an analysis with zones"});
        return Ranking(volume, held.arrays, analysis.extent().rank == 3).table(options);
    });
}

ObjectTable rank_objects(const Volume& volume, const Analysis& analysis, const RankOptions& options, const Context&) {
    return rank_objects(VolumeView(volume), analysis, options);
}

}  // namespace isoatlas
