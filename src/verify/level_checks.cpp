#include "verify/level_checks.h"

#include <string>
#include <utility>

namespace isoatlas {

LevelChecks::LevelChecks(const Analysis& analysis, std::vector<double> isovalues, EventOfVoxel event_of)
    : analysis_(analysis), isovalues_(std::move(isovalues)), event_of_(std::move(event_of)), tree_(analysis, isovalues_) {}

void LevelChecks::look_at(std::size_t i, const Cut& cut, const Surface& surface) {
    objects_ += static_cast<std::int64_t>(cut.objects.size());
    contours_ += static_cast<std::int64_t>(cut.contours.size());
    compare_tree_and_cut(analysis_, tree_, i, cut, event_of_, tree_equals_cut_);
    compare_arcs_and_cut(analysis_, cut, arcs_equal_cut_);
    if (analysis_.extent().rank == 2) {
        compare_cut_and_curves(cut, surface, cut_equals_mesh_);
    } else {
        look_at_mesh(cut, surface);
    }
}

void LevelChecks::look_at_mesh(const Cut& cut, const Surface& surface) {
    const SurfaceReport report = inspect(surface.points, surface.triangles);
    const std::string where = "at " + std::to_string(cut.tau) + ": ";
    if (!report.is_closed()) closed_.fail(where + std::to_string(report.boundary_edges) + " open edges");
    if (!report.is_manifold()) {
        manifold_.fail(where + std::to_string(report.non_manifold_edges) + " edges and " + std::to_string(report.non_manifold_points) +
                       " points");
    }
    if (!report.is_oriented()) oriented_.fail(where + std::to_string(report.misoriented_edges) + " edges");
    if (!report.has_no_zero_area()) no_zero_area_.fail(where + std::to_string(report.zero_area_triangles) + " triangles");
    triangles_ += report.triangles;
    compare_cut_and_mesh(cut, surface, report, cut_equals_mesh_);
}

void LevelChecks::add_results(std::vector<CheckResult>& results) const {
    const std::string seen = " at " + std::to_string(isovalues_.size()) + " isovalues", contours = std::to_string(contours_) + " contours";
    results.push_back(tree_equals_cut_.result(std::to_string(objects_) + " objects" + seen));
    results.push_back(arcs_equal_cut_.result(contours + seen));
    results.push_back(cut_equals_mesh_.result(contours + seen));
    if (analysis_.extent().rank == 2) return;
    for (const Check* check : {&closed_, &manifold_, &oriented_, &no_zero_area_})
        results.push_back(check->result(std::to_string(triangles_) + " triangles" + seen));
}

}  // namespace isoatlas
