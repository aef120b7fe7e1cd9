// Events between frames of an isovalue sweep: of all objects, and of the kept ones (noise would flood the captions).
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
    std::int64_t appeared = 0, merged = 0;  ///< since the previous frame, for descending isovalues
};

struct Frame {
    double tau = 0;  ///< stored
    std::int64_t events = 0;
    Census all, kept;
};

/// Kept are the objects of the selection, or the significant ones without a selection; their tunnels of a persistence above the noise level
/// (or --persistence); as cavities, those that the same selection or gate keeps.
class Evolution {
public:
    Evolution(const Arguments& arguments, Source& source);

    /// before: the isovalue of the previous frame.
    [[nodiscard]] Frame at(double tau, const std::optional<double>& before) const;
    /// The kept objects at an isovalue: their rank by id.
    [[nodiscard]] std::map<std::int64_t, std::int64_t> kept_objects(double tau) const;
    /// Are the isovalues at which the kept tunnels open and close exact?
    [[nodiscard]] bool has_exact_tunnels() const { return exact_tunnels_; }

private:
    /// Exists for tau in (ends, begins].
    struct Life {
        double begins, ends;
        [[nodiscard]] bool holds(double tau) const { return ends < tau && tau <= begins; }
    };

    Evolution(const Arguments& arguments, Source& source, std::pair<Analysis, BranchHierarchy> trees);
    void mark_kept(const BranchHierarchy& hierarchy, const std::vector<BranchId>& kept);
    [[nodiscard]] Census kept_at(double tau, const std::optional<double>& before) const;

    Analysis analysis_;  ///< the index refers to it
    std::optional<ActiveIndex> made_;
    const ActiveIndex* index_ = nullptr;
    std::vector<std::int64_t> rank_of_event_;  ///< of the kept object; -1: none
    std::vector<Life> objects_, tunnels_, cavities_;
    bool exact_tunnels_ = false;
};

}  // namespace isoatlas::cli
