// Topological simplification as a view: the full hierarchy of objects is computed once, the selection shown may change at any time.
//
// Every object of the volume is a branch: it appears at a maximum and ends where it merges with one of larger hypervolume. A selection
// keeps some branches. In the simplified tree the others are bypassed (dissertation, section 13.2 and figure 13.2): their zones join that
// of the object they merge into. Nothing of the tree, the volume or a surface changes.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "isoatlas/analysis.h"
#include "isoatlas/selection.h"

namespace isoatlas {

class Sink;

/// Stored values.
struct BranchInfo {
    std::int64_t id;         ///< index of the highest voxel of the object just before it merges
    EventId top;             ///< the event at which it begins, a maximum
    BranchId parent;         ///< the branch that it ends in; none: the main branch
    double appears, merges;  ///< on its own for tau in (merges, appears]; merges = -infinity: the main branch
    double persistence;      ///< highest value - merges (the main branch: - lowest sample)
    double hypervolume;      ///< sum of (value - merges); the rank
    std::int64_t voxels;     ///< just before it merges
    double measure;          ///< physical volume of these
};

/// The events of a branch, from its top down, those at which its object is still on its own. Cost: O(their number).
[[nodiscard]] std::vector<EventId> events_of(const Analysis& analysis, EventId top, double merges);

/// A node of the simplified tree: what happens to a kept object that is not bypassed. Its zone is the interval below it.
struct SimplifiedNode {
    EventId event;               ///< of the full tree
    BranchId branch;             ///< kept branch that it lies on
    std::int64_t parent;         ///< position of the next node going down; -1: the root, the last one
    bool is_maximum;             ///< the branch begins; else other kept branches end here
    double tau_low, tau_high;    ///< isovalues of its zone: (tau_low, tau_high]; tau_low of the root is -infinity
    std::int64_t voxels;         ///< of its zone, those of bypassed zones included
    std::int64_t object_voxels;  ///< just above tau_low: its voxels and those of the nodes above it
};

struct Simplified {
    std::vector<BranchId> kept;               ///< branches, by rank
    std::vector<SimplifiedNode> nodes;        ///< descending events: children before their parents
    std::vector<std::int64_t> node_of_event;  ///< per event of the full tree: position of the node whose zone its zone has joined
    std::int64_t hidden = 0;                  ///< branches that are not kept
    std::int64_t hidden_voxels = 0;           ///< voxels that lie in them
    double hidden_hypervolume = 0;            ///< of the largest of them
};

/// Number of objects by threshold of a size.
struct SelectionCurve {
    std::string size;                ///< "hypervolume", "persistence", "voxels"
    std::vector<double> threshold;   ///< descending; all objects have at least the last one
    std::vector<std::int64_t> kept;  ///< objects of at least that size
    double automatic_threshold = 0;  ///< the smallest size of an object that the gate of rank_objects() keeps
    std::int64_t automatic_kept = 0;
};

class BranchHierarchy {
public:
    /// analysis: of this volume, with zones. Throws Error{usage}. Cost: as rank_objects().
    BranchHierarchy(const Volume& volume, const Analysis& analysis, const Context& context = {});
    BranchHierarchy(BranchHierarchy&&) noexcept;
    BranchHierarchy& operator=(BranchHierarchy&&) noexcept;
    ~BranchHierarchy();

    /// All, by rank: in the order of their ids; the first is the main branch.
    [[nodiscard]] std::span<const BranchInfo> branches() const;
    /// The branches that a selection keeps, by rank. Cost: O(branches).
    [[nodiscard]] std::vector<BranchId> kept(const Selection& selection) const;
    /// The branches that noise does not explain and that are not tiny: the automatic choice, by rank.
    [[nodiscard]] const std::vector<BranchId>& significant() const;
    /// Cost: O(events).
    [[nodiscard]] Simplified simplify(const Selection& selection) const;
    /// The same for any kept branches: with a branch its parent must be among them, the main branch always.
    [[nodiscard]] Simplified simplify(std::vector<BranchId> kept) const;
    /// Of hypervolume, persistence and voxels. Cost: O(branches log branches).
    [[nodiscard]] std::vector<SelectionCurve> curves() const;

    struct Data;
    explicit BranchHierarchy(std::unique_ptr<Data> data);

private:
    std::unique_ptr<Data> data_;
};

/// The format follows the name: .csv, .svg (plots), .json (docs/schema/curves). Written to a temporary name and renamed. Throws Error:
/// usage (unknown extension), resource.
void write_curves(const std::string& path, const VolumeInfo& info, const std::vector<SelectionCurve>& curves);
void write_curves(Sink& sink, const VolumeInfo& info, const std::vector<SelectionCurve>& curves);

/// Input of a file of a simplified tree; all of the same volume.
struct SimplifiedTree {
    const VolumeInfo& info;
    const Analysis& analysis;
    const BranchHierarchy& hierarchy;
    const Simplified& simplified;
};
/// A node for each SimplifiedNode, an edge to its parent. The format follows the name: .json (docs/schema/simplified-tree), .graphml, .csv,
/// .vtu (points and lines, TTK array names). Values are reported values. Written to a temporary name and renamed. Throws Error: usage
/// (unknown extension), resource.
void write_simplified_tree(const std::string& path, const SimplifiedTree& tree);
void write_simplified_tree(Sink& sink, const SimplifiedTree& tree);
/// The same JSON document on a stream.
void write_simplified_tree_json(std::ostream& out, const SimplifiedTree& tree);

}  // namespace isoatlas
