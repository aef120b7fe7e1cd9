// Cavities: enclosed regions of low values, such as the pulp of a tooth, ranked as objects are.
//
// At an isovalue they are the low components: connected sets of samples below it, as the same interpolant connects them. That is not the
// table of the negated volume: which diagonal of a face is joined is decided once, for both sides. Samples at the border of the volume
// touch the outside; a low-value region that reaches the border is part of it and not a cavity.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "isoatlas/objects.h"

namespace isoatlas {

/// One cavity and the isovalue that shows it best. Its wall: extract() at best_tau with SurfaceOptions::contours = {id}.
struct CavityEntry {
    std::int64_t id;                 ///< index of its lowest voxel at best_tau: that of the contour around it (CutContour::id)
    double appears;                  ///< stored values: it is on its own for tau in (appears, merges]
    double merges;                   ///< with another cavity or the outside
    double best_tau;                 ///< stored value
    IsovalueReason reason;           ///< why there: stable, outline (nearly where it merges) or merge
    std::int64_t voxels;             ///< below best_tau
    double measure;                  ///< physical volume (area in 2D) of these
    double hypervolume;              ///< sum over the object at `merges` of (merges - value); the rank
    std::int64_t object;             ///< id at best_tau of the object that it is a cavity of
    std::int64_t tunnels;            ///< genus of its wall at best_tau; 2D: 0
    std::int64_t islands;            ///< objects inside it at best_tau
    std::array<double, 3> position;  ///< voxel coordinates of the lowest voxel
    double tau_low, tau_high;        ///< for isovalues in (tau_low, tau_high] nothing of this changes but its extent
    std::int64_t inside;             ///< position in CavityTable::entries of the closest entry that contains this one; -1: none
    std::int64_t branch_minimum;     ///< voxel of the minimum at which its branch begins; -1: unknown (stores of early versions)
    std::string note;                ///< "inside 3", ...
};

struct CavityTable {
    std::vector<CavityEntry> entries;  ///< by rank
    /// Of all cavities of the table, by their rank; of each by descending prominence, outlines last; best_tau is the first. branch_top is
    /// CavityEntry::branch_minimum. Empty: a store of an early version.
    std::vector<RecommendedIsovalue> isovalues{};
    std::int64_t branches = 0;  ///< how many cavities there are in all
    double noise = 0;           ///< estimated standard deviation of the noise, stored units
};

/// Ranked and gated as objects are; the outside is not listed. analysis: of this volume. Throws Error: usage (of another volume),
/// cancelled. Cost: that of an analysis without its trees; memory: one id a voxel and 60 bytes an event of the sublevel tree while it runs.
[[nodiscard]] CavityTable rank_cavities(const Volume& volume, const Analysis& analysis, const RankOptions& options = {},
                                        const Context& context = {});

struct ObjectsAndCavities {
    ObjectTable objects;
    CavityTable cavities;
};

/// Both tables, as rank_objects() and rank_cavities(), for little more than one of them. analysis: with zones.
[[nodiscard]] ObjectsAndCavities rank_both(const Volume& volume, const Analysis& analysis, const RankOptions& options = {},
                                           const Context& context = {});

/// The first entries alone (0: all): what rank_cavities() gives with that many at most.
[[nodiscard]] CavityTable first_entries(CavityTable table, std::int64_t top);

/// Per voxel: position (from 1) of the cavity that it lies in at tau, by descending voxels, then ascending id; 0: it is High, or outside.
/// ids: receives the id of each. Throws Error: usage (tau is not finite), cancelled. Cost: as above.
[[nodiscard]] std::vector<std::uint32_t> label_cavities(const Volume& volume, const Analysis& analysis, double tau,
                                                        std::vector<std::int64_t>& ids, const Context& context = {});

}  // namespace isoatlas
