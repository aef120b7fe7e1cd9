// FrontMesh: from leaves to points and triangles.
//
// Points are hits, in the order of octree_front/front_hits.h, then the centres of fans that are no hits, then
// what cells add, both in the order of the leaves. A leaf of level 1 or more is a fan around its centre: a hit inside it, or else the mean
// of its loop.
#pragma once

#include <span>
#include <vector>

#include "levelset/components.h"
#include "levelset/tau_level.h"
#include "mesh/cells.h"
#include "mesh/hits.h"
#include "octree_front/front_hits.h"
#include "octree_front/leaf_loop.h"

namespace isoatlas {

/// The fans of a row of leaves (octree_front/front_leaves.h).
struct RowFans {
    std::vector<EdgeHit> hits;               ///< of all loops
    std::vector<std::size_t> end;            ///< of each leaf of level 1 or more: where its loop ends in `hits`
    std::vector<EdgeHit> centre;             ///< of each such leaf; axis -1: the mean of its loop
    std::int64_t triangles = 0, points = 0;  ///< of the row, beside hits
};

/// Loops and centres of the leaves of a row, of level 1 or more.
void find_fans(const FrontLeaves& leaves, std::int64_t row, RowFans& fans);

template <class T>
class FrontMesh {
public:
    /// how: outlives this.
    FrontMesh(const TauLevel& level, const SampleGrid<T>& grid, const FrontLeaves& leaves, const ExtractOptions& how,
              const Context& context, const Components* components);
    /// Throws Error{resource}: a surface of all components has more than SurfaceOptions::max_triangles.
    void write(const std::vector<RowFans>& fans, Surface& surface);

private:
    void count_row(std::int64_t row, const RowFans& fans);
    void write_row(std::int64_t row, const RowFans& fans, Surface& surface) const;
    void write_fan(std::span<const EdgeHit> loop, const EdgeHit& centre, std::int64_t& next_point, std::array<std::int64_t, 3>*& triangle,
                   Surface& surface) const;
    [[nodiscard]] typename CellWriter<T>::State state_of(const FrontLeaf& leaf) const;

    const TauLevel& level_;
    SampleGrid<T> grid_;
    const FrontLeaves& leaves_;
    const Context& context_;
    FrontHits hits_;
    MeshDomain domain_;
    PhysicalMap map_;
    bool flip_;
    CellWriter<T> cells_;
    std::vector<std::array<std::int64_t, 2>> first_;  ///< point beside hits, triangle of each row of blocks
    const SurfaceOptions& options_;
    const Components* components_;  ///< null: points have no contours
};

}  // namespace isoatlas
