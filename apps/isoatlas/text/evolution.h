// What appears, merges and changes while the isovalue moves: of everything, and of what is kept, so that noise does not flood the labels.
#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <isoatlas/isoatlas.h>

namespace isoatlas::cli {

struct Arguments;
class Source;

struct Census {
    std::int64_t objects = 0, tunnels = 0, cavities = 0;
    std::int64_t appeared = 0, merged = 0;  ///< objects, since the frame before: on the way down
};

struct Frame {
    double tau = 0;  ///< stored
    std::int64_t events = 0;
    Census all, kept;
};

/// Kept are the objects of the selection, without one those that noise does not explain; of the tunnels of these, those that live longer
/// than noise rises (or --persistence says); dark objects that the same selection or gate keeps, as cavities.
class Evolution {
public:
    Evolution(const Arguments& arguments, Source& source);

    /// before: the isovalue of the frame before it.
    [[nodiscard]] Frame at(double tau, const std::optional<double>& before) const;
    /// The kept objects at an isovalue: their rank by id.
    [[nodiscard]] std::map<std::int64_t, std::int64_t> kept_objects(double tau) const;
    /// Is it exact from where to where each kept tunnel is open?
    [[nodiscard]] bool has_exact_tunnels() const { return exact_tunnels_; }

private:
    /// There for tau in (ends, begins].
    struct Life {
        double begins, ends;
        [[nodiscard]] bool holds(double tau) const { return ends < tau && tau <= begins; }
    };

    Evolution(const Arguments& arguments, Source& source, std::pair<Analysis, BranchHierarchy> trees);
    void mark_kept(const BranchHierarchy& hierarchy, const std::vector<std::int64_t>& kept);
    [[nodiscard]] Census kept_at(double tau, const std::optional<double>& before) const;

    Analysis analysis_;  ///< the index refers to it
    std::optional<ActiveIndex> made_;
    const ActiveIndex* index_ = nullptr;
    std::vector<std::int64_t> rank_of_event_;  ///< of the kept object; -1: none
    std::vector<Life> objects_, tunnels_, cavities_;
    bool exact_tunnels_ = false;
};

}  // namespace isoatlas::cli
