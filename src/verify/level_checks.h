// Compares tree, cut and surface at a list of isovalues: three independent computations.
#pragma once

#include <vector>

#include "verify/slice_checks.h"

namespace isoatlas {

class LevelChecks {
public:
    /// analysis must outlive this. isovalues: ascending.
    LevelChecks(const Analysis& analysis, std::vector<double> isovalues, EventOfVoxel event_of);

    [[nodiscard]] const std::vector<double>& isovalues() const { return isovalues_; }
    /// At isovalue number i.
    void look_at(std::size_t i, const Cut& cut, const Surface& surface);
    /// Tree against cut, contour tree against cut, cut against surface; in 3D the surface is closed, manifold, oriented, without slivers.
    void add_results(std::vector<CheckResult>& results) const;

private:
    void look_at_mesh(const Cut& cut, const Surface& surface);

    const Analysis& analysis_;
    std::vector<double> isovalues_;
    EventOfVoxel event_of_;
    TreeAtLevels tree_;
    Check tree_equals_cut_{"tree_equals_cut"}, arcs_equal_cut_{"contour_tree_equals_cut"}, cut_equals_mesh_{"cut_equals_mesh"};
    Check closed_{"surface_is_closed"}, manifold_{"surface_is_manifold"}, oriented_{"surface_is_oriented"},
        no_zero_area_{"surface_has_no_zero_area"};
    std::int64_t objects_ = 0, contours_ = 0, triangles_ = 0;
};

}  // namespace isoatlas
