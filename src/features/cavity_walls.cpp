#include "features/cavity_walls.h"

#include <limits>

#include "base/paced_fill.h"
#include "base/streamed.h"
#include "features/select_branches.h"
#include "features/stable_isovalue.h"
#include "isoatlas/active.h"

namespace isoatlas {
namespace {

constexpr std::size_t kMaxCavities = 5;  // of one branch; all are in the table of cavities
constexpr double kNoHeight = std::numeric_limits<double>::infinity();

/// The row of the closest branch that has one, itself or one it ends in; -1: there is none.
template <class Id>
IdArray<BranchId, std::int64_t> rows_of_branches(const CavityCandidates<Id>& candidates) {
    const std::vector<Candidate>& rows = candidates.chosen.rows;
    IdArray<BranchId, std::int64_t> own(filled(candidates.branches.branch.size(), std::int64_t{-1}));
    for (std::size_t row = 0; row < rows.size(); ++row) own[rows[row].branch] = static_cast<std::int64_t>(row);
    IdArray<BranchId, std::int64_t> result(own.size());
    for (const BranchId i : streamed<BranchId>(result.size(), at_random())) {
        result[i] = own[i];
        for (BranchId b = i; b.exists() && result[i] < 0; b = candidates.branches.branch[b].parent) result[i] = own[b];
    }
    return result;
}

/// The isovalue up to which a voxel of the zone of an event belongs to a branch; -infinity: never.
double joins(const BranchDecomposition& branches, EventId event, double value, BranchId branch) {
    BranchId b = branches.of_event[event];
    for (; b != branch; b = branches.branch[b].parent) {
        if (!branches.branch[b].parent.exists()) return -kNoHeight;
        value = branches.branch[b].merges;
    }
    return value;
}

/// While a sublevel branch lies in another one it is closed as long as that is.
template <class Id>
void widen(std::vector<std::vector<Enclosure>>& all, const CavityCandidates<Id>& candidates) {
    const std::vector<Candidate>& rows = candidates.chosen.rows;
    const IdArray<BranchId, std::int64_t> row_of = rows_of_branches(candidates);
    const std::vector<std::vector<Enclosure>> own = all;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        for (BranchId b = candidates.branches.branch[rows[i].branch].parent; b.exists(); b = candidates.branches.branch[b].parent) {
            if (row_of[b] < 0) break;
            b = rows[row_of[b]].branch;
            for (const Enclosure& outer : own[row_of[b]]) {
                const auto same = std::ranges::find(all[i], outer.branch, &Enclosure::branch);
                if (same == all[i].end()) {
                    all[i].push_back(outer);
                } else {
                    same->closed = std::max(same->closed, outer.closed);
                }
            }
        }
    }
}

/// Where the histogram of a branch is; -1: it has none.
IdArray<BranchId, std::int64_t> slots(const std::vector<BranchHistogram>& histograms, std::size_t branches) {
    IdArray<BranchId, std::int64_t> slot(filled(branches, std::int64_t{-1}));
    for (std::size_t i = 0; i < histograms.size(); ++i) slot[histograms[i].branch] = static_cast<std::int64_t>(i);
    return slot;
}

bool is_new(double tau, const BranchHistogram& histogram, const std::vector<BranchIsovalue>& known) {
    return std::ranges::none_of(known, [&](const BranchIsovalue& isovalue) {
        return isovalue.branch == histogram.branch && isovalue.prominence > 0 &&
               std::abs(histogram.axis.position(isovalue.tau) - histogram.axis.position(tau)) <= kSmoothedBins * histogram.width();
    });
}

template <class Id>
class Walls {
public:
    Walls(const VolumeView& volume, const AnalysisArrays<Id>& arrays, const ObjectTree<Id>& objects, const BranchDecomposition& branches,
          const CandidateTable& chosen, const CavityCandidates<Id>& candidates, const std::vector<EventId>& around)
        : volume_(volume),
          arrays_(arrays),
          chosen_(chosen),
          candidates_(candidates),
          enclosures_(enclosures(objects, branches, candidates, around)),
          filled_(fill_cavities(volume, objects, branches, chosen.histograms, candidates, enclosures_)) {}

    [[nodiscard]] std::vector<BranchIsovalue> all() const {
        std::vector<BranchIsovalue> result;
        for (const BranchHistogram& filled : filled_) {
            add_outer(filled, result);
            add_inner(filled, result);
        }
        return result;
    }

private:
    void add_outer(const BranchHistogram& filled, std::vector<BranchIsovalue>& result) const {
        const auto min = static_cast<double>(min_voxels(volume_.info->extent.voxels()));
        for (const StableIsovalue& peak : stable_isovalues(filled)) {
            if (peak.at_low_end || peak.volume < min || !has_cavity(filled.branch, peak.tau)) continue;
            if (is_new(peak.tau, filled, chosen_.isovalues))
                result.push_back({filled.branch, peak.tau, peak.prominence, IsovalueReason::outer});
        }
    }

    /// A cavity of a branch at an isovalue?
    [[nodiscard]] bool is_cavity(std::size_t row, BranchId branch, double tau) const {
        if (!(-candidates_.chosen.rows[row].appears < tau)) return false;
        const auto around = std::ranges::find(enclosures_[row], branch, &Enclosure::branch);
        return around != enclosures_[row].end() && tau <= around->closed;
    }
    [[nodiscard]] bool has_cavity(BranchId branch, double tau) const {
        for (std::size_t row = 0; row < enclosures_.size(); ++row) {
            if (is_cavity(row, branch, tau)) return true;
        }
        return false;
    }

    /// The branch around a row at its isovalue: the last one that it enters on the way down to there.
    [[nodiscard]] bool is_around(std::size_t row, BranchId branch, double tau) const {
        if (!is_cavity(row, branch, tau)) return false;
        const auto around = std::ranges::find(enclosures_[row], branch, &Enclosure::branch);
        return std::ranges::none_of(enclosures_[row],
                                    [&](const Enclosure& other) { return tau <= other.closed && other.closed < around->closed; });
    }

    void add_inner(const BranchHistogram& filled, std::vector<BranchIsovalue>& result) const {
        std::size_t count = 0;
        for (std::size_t row = 0; row < enclosures_.size() && count < kMaxCavities; ++row) {
            const Candidate& cavity = candidates_.chosen.rows[row];
            const auto why = std::ranges::find(candidates_.chosen.isovalues, cavity.branch, &BranchIsovalue::branch);
            const double tau = -cavity.tau;
            if (why->reason != IsovalueReason::stable || !is_around(row, filled.branch, tau)) continue;
            if (!is_new(tau, filled, chosen_.isovalues)) continue;
            result.push_back({filled.branch, tau, why->prominence, IsovalueReason::inner, candidates_.voxel(arrays_, cavity.event)});
            ++count;
        }
    }

    const VolumeView& volume_;
    const AnalysisArrays<Id>& arrays_;
    const CandidateTable& chosen_;
    const CavityCandidates<Id>& candidates_;
    std::vector<std::vector<Enclosure>> enclosures_;
    std::vector<BranchHistogram> filled_;
};

}  // namespace

template <class Id>
std::vector<EventId> objects_around(const Analysis& analysis, const AnalysisArrays<Id>& arrays, const CavityCandidates<Id>& candidates) {
    std::vector<EventId> around;
    const ActiveIndex index(analysis);
    for (const Candidate& row : candidates.chosen.rows) {
        const Branch& b = candidates.branches.branch[row.branch];
        const ActiveObjects there = index.at(-b.merges);
        const std::int64_t id = lowest_voxel(arrays, candidates.sublevel, b.highest);
        const auto wall = std::ranges::find_if(
            there.contours, [id](const ActiveContour& contour) { return contour.shell == Shell::inner && contour.id == id; });
        if (wall == there.contours.end()) throw Error(ErrorKind::internal, {.what = "a cavity without a wall"});
        around.push_back(std::ranges::find(there.objects, wall->object, &ActiveObject::id)->event);
    }
    return around;
}

template <class Id>
std::vector<std::vector<Enclosure>> enclosures(const ObjectTree<Id>& objects, const BranchDecomposition& branches,
                                               const CavityCandidates<Id>& candidates, const std::vector<EventId>& around) {
    std::vector<std::vector<Enclosure>> all(around.size());
    for (std::size_t row = 0; row < around.size(); ++row) {
        const double appears = -candidates.chosen.rows[row].appears;
        double closed = -candidates.chosen.rows[row].merges;
        for (EventId e = around[row]; appears < closed; e = objects.parent(e)) {
            const BranchId branch = branches.of_event[e];
            if (all[row].empty() || all[row].back().branch != branch) all[row].push_back({branch, closed});
            if (objects.is_root(e)) break;
            closed = objects.height[objects.parent(e)];
        }
    }
    return all;
}

template <class Id>
std::vector<BranchHistogram> fill_cavities(const VolumeView& volume, const ObjectTree<Id>& objects, const BranchDecomposition& branches,
                                           std::vector<BranchHistogram> histograms, const CavityCandidates<Id>& candidates,
                                           const std::vector<std::vector<Enclosure>>& enclosures) {
    std::vector<std::vector<Enclosure>> filled = enclosures;
    widen(filled, candidates);
    const IdArray<BranchId, std::int64_t> slot = slots(histograms, branches.branch.size());
    for (std::vector<Enclosure>& one : filled) std::erase_if(one, [&](const Enclosure& e) { return slot[e.branch] < 0; });
    const IdArray<BranchId, std::int64_t> row_of = rows_of_branches(candidates);
    objects.for_heights(volume, at_random(2), [&](VoxelId v, double value) {
        const std::int64_t row = row_of[candidates.branches.of_event[candidates.tree.zone(v)]];
        if (row < 0) return;
        for (const Enclosure& around : filled[row]) {
            const double from = joins(branches, objects.zone(v), value, around.branch);
            if (!(from < around.closed)) continue;
            BranchHistogram& histogram = histograms[slot[around.branch]];
            histogram.added.back() += 1;  // it was there before, in the cavity
            if (from > -kNoHeight) histogram.add(from, -1);
        }
    });
    return histograms;
}

template <class Id>
std::vector<BranchIsovalue> wall_isovalues(const VolumeView& volume, const AnalysisArrays<Id>& arrays, const ObjectTree<Id>& objects,
                                           const BranchDecomposition& branches, const CandidateTable& chosen,
                                           const CavityCandidates<Id>& candidates, const std::vector<EventId>& around) {
    return Walls<Id>(volume, arrays, objects, branches, chosen, candidates, around).all();
}

#define ISOATLAS_WALLS(Id)                                                                                                              \
    template std::vector<EventId> objects_around(const Analysis&, const AnalysisArrays<Id>&, const CavityCandidates<Id>&);              \
    template std::vector<std::vector<Enclosure>> enclosures(const ObjectTree<Id>&, const BranchDecomposition&,                          \
                                                            const CavityCandidates<Id>&, const std::vector<EventId>&);                  \
    template std::vector<BranchHistogram> fill_cavities(const VolumeView&, const ObjectTree<Id>&, const BranchDecomposition&,           \
                                                        std::vector<BranchHistogram>, const CavityCandidates<Id>&,                      \
                                                        const std::vector<std::vector<Enclosure>>&);                                    \
    template std::vector<BranchIsovalue> wall_isovalues(const VolumeView&, const AnalysisArrays<Id>&, const ObjectTree<Id>&,            \
                                                        const BranchDecomposition&, const CandidateTable&, const CavityCandidates<Id>&, \
                                                        const std::vector<EventId>&);
ISOATLAS_WALLS(std::uint32_t)
ISOATLAS_WALLS(std::uint64_t)
#undef ISOATLAS_WALLS

}  // namespace isoatlas
