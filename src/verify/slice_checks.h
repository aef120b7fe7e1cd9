// Checks at single isovalues: three independent computations must agree. tree (Analysis), cut (flood of the volume), mesh
// (extract).
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "isoatlas/cut.h"
#include "isoatlas/verify.h"
#include "verify/checks.h"

namespace isoatlas {

/// Isovalues spread over the samples: alternately a data value and the middle between two neighbouring ones; the lowest and highest value
/// are in. At most `count`, ascending, distinct.
[[nodiscard]] std::vector<double> isovalues_to_check(const Volume& volume, int count);

/// The lowest and highest sample, and `count` isovalues drawn with a seed: alternately a sample and a value between two samples. Ascending,
/// distinct.
[[nodiscard]] std::vector<double> random_isovalues(const Volume& volume, int count, std::uint64_t seed);

/// The objects of the tree at some isovalues. Built in one traversal, because the genera of all events together can be huge.
class TreeAtLevels {
public:
    struct Object {
        EventId event;
        std::int64_t chi, b1, b2;
        std::int64_t min_voxels, max_voxels;  ///< at the ends of its zone; 0, 0: not counted
        std::vector<std::int64_t> genera;     ///< sorted
    };
    TreeAtLevels(const Analysis& analysis, const std::vector<double>& isovalues);

    /// The objects at isovalue number i, by event.
    [[nodiscard]] const std::vector<Object>& objects(std::size_t i) const { return objects_[i]; }
    /// For every event: the event of the object at isovalue number i that it has become part of, none when its zones lie below.
    [[nodiscard]] std::vector<EventId> owner(const Analysis& analysis, std::size_t i) const;

private:
    std::vector<std::vector<Object>> objects_;
};

/// The event at which the maximum that represents an object appears; none: it is not known.
using EventOfVoxel = std::function<EventId(VoxelId)>;

/// Each object of the cut is exactly one of the tree: found by its representative voxel, with the same Betti numbers and genera, and a
/// number of voxels within the bounds of its zone.
void compare_tree_and_cut(const Analysis& analysis, const TreeAtLevels& tree, std::size_t i, const Cut& cut, const EventOfVoxel& event_of,
                          Check& check);

/// The genera of the contour tree's arcs that pass tau are the genera of the cut's contours.
void compare_arcs_and_cut(const Analysis& analysis, const Cut& cut, Check& check);

/// One component of the surface per contour of the cut, each with Euler number 2 - 2 genus. 3D.
void compare_cut_and_mesh(const Cut& cut, const Surface& surface, const SurfaceReport& report, Check& check);

/// 2D: closed oriented curves, one per contour.
void compare_cut_and_curves(const Cut& cut, const Surface& surface, Check& check);

}  // namespace isoatlas
