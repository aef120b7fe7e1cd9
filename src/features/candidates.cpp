#include "features/candidates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>

#include "analysis/object_tree.h"
#include "base/paced_fill.h"
#include "base/streamed.h"
#include "features/main_branch_isovalues.h"
#include "features/select_branches.h"
#include "features/stable_isovalue.h"

namespace isoatlas {
namespace {

constexpr double kLargePart = 0.15;  // of the volume: a branch that ends so large is everything but background

constexpr double kShownPart = 0.01;  // of the hypervolume of an object: where less is left, an isovalue does not show it

constexpr std::size_t kMostOfBytes = 1024;  // histograms that are counted by value first, 2 kB each

constexpr IsovalueReason kOutline = IsovalueReason::outline;

template <class Id>
class Rows {
    using Slot = Id;  ///< of a branch among those that are kept
    static constexpr Slot kNoSlot = std::numeric_limits<Slot>::max();

public:
    Rows(const VolumeView& volume, const ObjectTree<Id>& tree, const BranchDecomposition& branches)
        : volume_(volume), tree_(tree), branches_(branches), axis_(axis_scale(volume), tree.sign) {}

    [[nodiscard]] CandidateTable choose(const NoiseModel& noise, const RankOptions& options) const {
        CandidateTable result = choose_isovalues(chosen(noise, options), options, noise);
        std::vector<Candidate>& rows = result.rows;
        if (options.top > 0 && static_cast<std::int64_t>(rows.size()) > options.top) rows.resize(static_cast<std::size_t>(options.top));
        const BranchId last = rows.empty() ? BranchId::none() : rows.back().branch;
        std::erase_if(result.isovalues, [last](const BranchIsovalue& isovalue) { return isovalue.branch > last; });
        std::erase_if(result.histograms, [last](const BranchHistogram& histogram) { return histogram.branch > last; });
        measure(rows);
        return result;
    }

private:
    [[nodiscard]] bool is_superlevel() const { return tree_.sign > 0; }
    [[nodiscard]] double lowest() const { return branches_.lowest; }

    /// The significant branches by rank, whatever is selected.
    [[nodiscard]] std::vector<BranchId> significant(const NoiseModel& noise) const {
        return significant_branches(branches_, volume_.info->extent.voxels(), noise, tree_.sign);
    }

    /// By rank.
    [[nodiscard]] std::vector<BranchId> chosen(const NoiseModel& noise, const RankOptions& options) const {
        std::vector<BranchId> kept;
        if (options.selection) {
            const bool measured = options.selection->min_measure > 0;
            const IdArray<BranchId, double> measure =
                measured ? branch_measures(tree_, branches_, *volume_.info) : IdArray<BranchId, double>();
            kept = select_branches(branches_, measure, *options.selection);
        } else if (options.gate) {
            kept = significant(noise);
        } else {
            kept.resize(branches_.branch.size());
            std::iota(kept.begin(), kept.end(), kMainBranch);
        }
        return kept;
    }

    /// Histograms along the kept branches: own voxels by height, whole merged branches at the height where they merge.
    [[nodiscard]] std::vector<BranchHistogram> histograms(const std::vector<BranchId>& kept) const {
        const bool integer = !is_floating(volume_.info->type);
        IdArray<BranchId, Slot> slot(filled(branches_.branch.size(), kNoSlot));
        std::vector<BranchHistogram> result;
        for (const std::size_t k : streamed(kept.size(), at_random(2))) {
            const Branch& b = branches_.branch[kept[k]];
            slot[kept[k]] = static_cast<Slot>(k);
            result.emplace_back(kept[k], std::max(b.merges, lowest()), b.appears, integer, axis_);
        }
        const IdArray<EventId, Slot> of_event = slots_of_events(slot);
        visit_samples(volume_, [&]<class T>(std::span<const T> samples) {
            if constexpr (sizeof(T) == 1) {
                if (result.size() <= kMostOfBytes) return add_bytes(samples, of_event, result);
            }
            tree_.for_heights(volume_, at_random(), [&](VoxelId v, double height) {
                const Slot k = of_event[tree_.zone(v)];
                if (k != kNoSlot) result[k].add(height, 1);
            });
        });
        for (const BranchId i : streamed<BranchId>(branches_.branch.size(), {sizeof(Branch) + at_random().bytes})) {
            const Branch& b = branches_.branch[i];
            const Slot k = i == kMainBranch ? kNoSlot : slot[b.parent];
            if (k != kNoSlot) result[k].add(b.merges, static_cast<double>(b.voxels));
        }
        return result;
    }
    /// The own voxels, counted by their value first: samples of a byte have few.
    template <class T>
    void add_bytes(std::span<const T> samples, const IdArray<EventId, Slot>& of_event, std::vector<BranchHistogram>& histograms) const {
        std::vector<std::array<std::int64_t, 256>> counts(histograms.size());
        for (const VoxelId v : streamed<VoxelId>(samples.size(), {sizeof(T) + sizeof(Id) + at_random().bytes})) {
            const Slot k = of_event[tree_.zone(v)];
            if (k != kNoSlot) ++counts[k][static_cast<std::uint8_t>(samples[v.index()])];
        }
        for (std::size_t k = 0; k < counts.size(); ++k) {
            for (std::size_t i = 0; i < counts[k].size(); ++i) {
                const auto sample = static_cast<double>(static_cast<T>(static_cast<std::uint8_t>(i)));
                if (counts[k][i] > 0) histograms[k].add(tree_.sign * sample, static_cast<double>(counts[k][i]));
            }
        }
    }
    /// One access a voxel instead of two far ones.
    [[nodiscard]] IdArray<EventId, Slot> slots_of_events(const IdArray<BranchId, Slot>& slot) const {
        IdArray<EventId, Slot> result(tree_.size());
        for (const EventId e : streamed<EventId>(tree_.size(), at_random())) result[e] = slot[branches_.of_event[e]];
        return result;
    }

    /// chosen: of which more than there may be rows get none.
    [[nodiscard]] CandidateTable choose_isovalues(const std::vector<BranchId>& chosen, const RankOptions& options,
                                                  const NoiseModel& noise) const {
        std::vector<BranchId> kept = chosen;
        if (options.top > 0 && static_cast<std::int64_t>(kept.size()) > options.top + 1)
            kept.resize(static_cast<std::size_t>(options.top) + 1);
        CandidateTable result{{}, {}, histograms(kept)};
        for (std::size_t k = 0; k < kept.size(); ++k) {
            const Branch& b = branches_.branch[kept[k]];
            std::vector<BranchIsovalue> own = isovalues(kept[k], result.histograms[k]);
            std::size_t rows = 1;
            if (k == 0 && is_superlevel()) {  // the main branch of sublevel sets is the outside, which has no rows
                const std::vector<BranchIsovalue> more = before_merges(branches_, significant(noise), result.histograms[k], own, noise);
                own.insert(std::ranges::find(own, kOutline, &BranchIsovalue::reason), more.begin(), more.end());
                rows = arrange_main_branch(own, volume_.info->extent.voxels());
            }
            for (std::size_t i = 0; i < rows; ++i)
                result.rows.push_back({kept[k], b.appears, b.merges, own[i].tau, b.hypervolume, own[i].reason == kOutline});
            result.isovalues.insert(result.isovalues.end(), own.begin(), own.end());
        }
        return result;
    }

    /// At the low end of the range, or the lowest one and large; a single one must be both
    /// (docs/theory/7-which-objects-matter.md#stable-isovalues).
    [[nodiscard]] bool is_outline(const StableIsovalue& peak, const std::vector<StableIsovalue>& peaks) const {
        const bool is_large = peak.volume > kLargePart * static_cast<double>(volume_.info->extent.voxels());
        if (peaks.size() == 1) return peak.at_low_end && is_large;
        return peak.at_low_end || (is_large && peak.tau == std::ranges::min(peaks, {}, &StableIsovalue::tau).tau);
    }

    /// At least one.
    [[nodiscard]] std::vector<BranchIsovalue> isovalues(BranchId branch, const BranchHistogram& histogram) const {
        const Branch& b = branches_.branch[branch];
        std::vector<StableIsovalue> peaks = stable_isovalues(histogram);
        const std::int64_t min = min_voxels(volume_.info->extent.voxels());  // below it the gaps between values of single voxels dominate
        std::erase_if(peaks, [min](const StableIsovalue& peak) { return peak.volume < static_cast<double>(min); });
        if (branch != kMainBranch) {  // whose isovalues may show things of any size
            const double least = kShownPart * histogram.hypervolume_above(b.merges);
            std::erase_if(peaks, [&](const StableIsovalue& peak) { return histogram.hypervolume_above(peak.tau) < least; });
        }
        std::vector<BranchIsovalue> own;
        for (const StableIsovalue& peak : peaks)
            own.push_back({branch, alive(peak.tau, b), peak.prominence, is_outline(peak, peaks) ? kOutline : IsovalueReason::stable, -1,
                           peak.volume});
        std::ranges::stable_partition(own, [](const BranchIsovalue& isovalue) { return isovalue.reason != kOutline; });
        if (own.empty()) {
            const bool is_main_branch = b.merges < lowest();
            own.push_back({branch, alive(just_above(b, histogram), b), 0, is_main_branch ? IsovalueReason::middle : IsovalueReason::merge,
                           -1, static_cast<double>(b.voxels)});
        }
        return own;
    }

    /// The closest isovalue at which the branch is there. A sample is High when its value is at least tau, Low when it is below: in
    /// heights, a branch of superlevel sets lives in (merges, appears], one of sublevel sets in [merges, appears).
    [[nodiscard]] double alive(double tau, const Branch& b) const {
        const double end = std::max(b.merges, lowest());
        if (is_superlevel()) return std::clamp(tau, std::nextafter(end, b.appears), b.appears);
        return std::clamp(tau, end, std::nextafter(b.appears, end));
    }

    /// No isovalue is stable: one bin above the height at which the branch ends, the middle of the range for the main branch.
    [[nodiscard]] double just_above(const Branch& b, const BranchHistogram& histogram) const {
        if (b.merges < lowest()) return (lowest() + b.appears) / 2;
        const double room = histogram.axis.position(b.appears) - histogram.low;
        return histogram.axis.height(histogram.low + std::min(histogram.width(), room / 2));
    }

    /// Does a sample of a height belong to the object of its branch at tau?
    [[nodiscard]] bool belongs(double height, double tau) const { return is_superlevel() ? height >= tau : height > tau; }

    /// The event of every row, and the voxels of its object at tau.
    void measure(std::vector<Candidate>& rows) const {
        const Extent& extent = volume_.info->extent;
        const bool uniform = std::all_of(volume_.info->geometry.coordinates.begin(), volume_.info->geometry.coordinates.end(),
                                         [](const auto& c) { return c.size() < 2; });
        std::vector<bool> wanted(tree_.size(), false);
        std::multimap<EventId, Candidate*> of_event;
        for (Candidate& row : rows) {
            row.event = branches_.branch[row.branch].top;
            while (!tree_.is_root(row.event) && belongs(tree_.height[tree_.parent(row.event)], row.tau))
                row.event = tree_.parent(row.event);
            row.voxels = branches_.objects.voxels[row.event] - static_cast<std::int64_t>(tree_.voxels[row.event]);  // of its children
            wanted[row.event.index()] = true;
            of_event.emplace(row.event, &row);
        }
        tree_.for_heights(volume_, {0}, [&](VoxelId v, double height) {
            const EventId zone = tree_.zone(v);
            if (!wanted[zone.index()]) return;
            const auto [begin, end] = of_event.equal_range(zone);
            for (auto i = begin; i != end; ++i) i->second->voxels += belongs(height, i->second->tau);
        });
        for (Candidate& row : rows) {
            row.measure =
                uniform ? static_cast<double>(row.voxels) * voxel_measure(volume_.info->geometry, extent, 0) : rectilinear_measure(row);
        }
    }

    /// Sum of voxel boxes of the object of a row; one pass, on rectilinear grids only.
    [[nodiscard]] double rectilinear_measure(const Candidate& row) const {
        std::vector<bool> inside(tree_.size(), false);  // children have smaller numbers: parents first
        for (EventId e = row.event; e.exists(); e = e.previous())
            inside[e.index()] = e == row.event || (!tree_.is_root(e) && inside[tree_.parent(e).index()]);
        double sum = 0;
        tree_.for_heights(volume_, {0}, [&](VoxelId v, double height) {
            if (inside[tree_.zone(v).index()] && belongs(height, row.tau))
                sum += voxel_measure(volume_.info->geometry, volume_.info->extent, v.number());
        });
        return sum;
    }

    const VolumeView& volume_;
    const ObjectTree<Id>& tree_;
    const BranchDecomposition& branches_;
    HeightAxis axis_;
};

/// Rows by event, then by falling tau.
std::vector<std::size_t> by_event(const std::vector<Candidate>& rows) {
    std::vector<std::size_t> order(rows.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, [&rows](std::size_t p, std::size_t q) {
        return rows[p].event != rows[q].event ? rows[p].event < rows[q].event : rows[p].tau > rows[q].tau;
    });
    return order;
}

}  // namespace

template <class Id>
CandidateTable find_candidates(const VolumeView& volume, const ObjectTree<Id>& tree, const BranchDecomposition& branches,
                               const NoiseModel& noise, const RankOptions& options) {
    return Rows<Id>(volume, tree, branches).choose(noise, options);
}

template <class Id>
std::vector<std::int64_t> closest_around(const ObjectTree<Id>& tree, const std::vector<Candidate>& rows) {
    constexpr std::int64_t none = -1;
    const std::vector<std::size_t> order = by_event(rows);
    // Per event: the first place in `order` of it or of the next one below with rows.
    IdArray<EventId, std::int64_t> first(filled(tree.size(), none));
    for (std::size_t k = order.size(); k-- > 0;) first[rows[order[k]].event] = static_cast<std::int64_t>(k);
    for (const EventId e : streamed_down<EventId>(tree.size(), at_random())) {
        if (first[e] == none && !tree.is_root(e)) first[e] = first[tree.parent(e)];
    }
    std::vector<std::int64_t> around(rows.size(), none);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        for (std::int64_t k = first[rows[i].event]; k != none && around[i] == none;) {
            const EventId event = rows[order[k]].event;
            for (auto at = static_cast<std::size_t>(k); at < order.size() && rows[order[at]].event == event && around[i] == none; ++at) {
                if (rows[order[at]].tau < rows[i].tau) around[i] = static_cast<std::int64_t>(order[at]);
            }
            k = tree.is_root(event) ? none : first[tree.parent(event)];
        }
    }
    return around;
}

#define ISOATLAS_BRANCH_ROWS(Id)                                                                                                     \
    template CandidateTable find_candidates(const VolumeView&, const ObjectTree<Id>&, const BranchDecomposition&, const NoiseModel&, \
                                            const RankOptions&);                                                                     \
    template std::vector<std::int64_t> closest_around(const ObjectTree<Id>&, const std::vector<Candidate>&);
ISOATLAS_BRANCH_ROWS(std::uint32_t)
ISOATLAS_BRANCH_ROWS(std::uint64_t)
#undef ISOATLAS_BRANCH_ROWS

}  // namespace isoatlas
