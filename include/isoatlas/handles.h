// Handles: birth and death isovalues of tunnels.
//
// Going down, an element that joins a contour with itself opens a tunnel, one that fills a hole closes one. Both are exact, and so is how
// many tunnels each contour has at every isovalue. Which of the open tunnels is closed does not follow from the trees:
//   pair_handles           takes the one that was opened last, along the contour and all that it merges into. So the number of handles and
//                          the sum of their persistence are exact, *individual pairs are approximate*.
//   pair_handles_exactly   reads the samples: the pairs are the persistence pairs of the first homology of the Highs
//                          (docs/decisions/0018).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "isoatlas/analysis.h"

namespace isoatlas {

/// A tunnel for tau in (closes, opens]. Stored values; positions in voxel coordinates.
struct Handle {
    double opens, closes;
    std::array<double, 3> opened_at, closed_at;
    EventId event;         ///< at which it opens, of the object whose tunnel it is then
    bool is_open = false;  ///< of one object alone: it is still open where the object merges, which `closes` is then
    [[nodiscard]] double persistence() const { return opens - closes; }
};

/// By descending persistence, then ascending element that opens it; those of at least that persistence, which is above 0. 2D: none, holes
/// are contours there. Cost: O(elements log^2 elements).
[[nodiscard]] std::vector<Handle> pair_handles(const Analysis& analysis, double min_persistence = 0);

struct ExactHandles {
    double min_persistence = 0;
    /// Only the object of this event at the low end of its zone: all that happens in it down to there. None: the whole volume.
    EventId event = EventId::none();
    /// Refuse more tunnels than that: their number is known from the trees at once, the time is not.
    std::int64_t max = 1'000'000;
};

/// The same handles, each with the isovalue at which it truly closes. Persistence of H1 mod 2 over the critical elements that the join tree
/// (objects that merge) and the split tree (cavities that part) have not paired. analysis: of this volume. Order: as pair_handles(). Throws
/// Error: usage (another volume, no such event, more than `max` tunnels), cancelled. Cost: a gradient disk for every tunnel that closes,
/// traced as far as the reduction of a sparse matrix needs it, and what is left of it in memory; no useful bound is known,
/// docs/decisions/0018 and 0047 have measured ones. The same for any number of threads.
[[nodiscard]] std::vector<Handle> pair_handles_exactly(const Volume& volume, const Analysis& analysis, const ExactHandles& options = {},
                                                       const Context& context = {});

struct FoundHandles {
    std::vector<Handle> handles;
    bool exact;
};

/// Exact pairs where they cost little: of at most 2^26 bytes of samples and 2^17 tunnels; else approximate ones. samples: called for exact
/// pairs only; the volume that analysis is of. Throws Error: cancelled, what samples() throws. Cost: seconds at most.
[[nodiscard]] FoundHandles find_handles(const VolumeInfo& info, const Analysis& analysis, double min_persistence,
                                        const std::function<Volume()>& samples, const Context& context = {});

/// The largest object whose highest voxel is that one: the event just before it merges with a higher object, the root for the highest
/// voxel of all; none: the voxel is not the highest of any object. Cost: O(elements + events).
[[nodiscard]] EventId event_of_highest(const Analysis& analysis, VoxelId voxel);

}  // namespace isoatlas
