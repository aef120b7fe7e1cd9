// verify_volume: the analysis checked against itself, then tree, cut and surface against each other at some isovalues.
#include <string>

#include "verify/slice_checks.h"
#include "verify/tree_checks.h"

namespace isoatlas {
namespace {

struct SurfaceChecks {
    Check equals{"cut_equals_mesh"}, closed{"surface_is_closed"}, manifold{"surface_is_manifold"}, oriented{"surface_is_oriented"},
        no_zero_area{"surface_has_no_zero_area"};
    std::int64_t triangles = 0;
};

void check_surface(const Volume& volume, const Cut& cut, SurfaceChecks& checks, const Context& context) {
    ExtractOptions options;
    options.interpolant = cut.interpolant;
    options.tunnel_height = cut.tunnel_height;
    options.normals = false;
    const Surface surface = extract(volume, cut.tau, options, context);
    if (volume.info.extent.rank == 2) {
        compare_cut_and_curves(cut, surface, checks.equals);
        return;
    }
    const SurfaceReport report = inspect(surface.points, surface.triangles);
    const std::string where = "at " + std::to_string(cut.tau) + ": ";
    if (!report.is_closed()) checks.closed.fail(where + std::to_string(report.boundary_edges) + " open edges");
    if (!report.is_manifold()) {
        checks.manifold.fail(where + std::to_string(report.non_manifold_edges) + " edges and " +
                             std::to_string(report.non_manifold_points) + " points");
    }
    if (!report.is_oriented()) checks.oriented.fail(where + std::to_string(report.misoriented_edges) + " edges");
    if (!report.has_no_zero_area()) checks.no_zero_area.fail(where + std::to_string(report.zero_area_triangles) + " triangles");
    checks.triangles += report.triangles;
    compare_cut_and_mesh(cut, surface, report, checks.equals);
}

}  // namespace

std::vector<CheckResult> verify_volume(const Volume& volume, const VerifyOptions& options, const Context& context) {
    const Analysis analysis = analyse(volume, {.interpolant = options.interpolant, .tunnel_height = options.tunnel_height}, context);
    std::vector<CheckResult> results{join_tree_is_valid(analysis), zones_partition_voxels(analysis, volume), euler_sums_hold(analysis),
                                     contour_tree_is_a_tree(analysis), levels_match_events(analysis)};

    const std::vector<double> isovalues = isovalues_to_check(volume, options.levels);
    const TreeAtLevels tree(analysis, isovalues);
    Check tree_equals_cut("tree_equals_cut"), arcs_equal_cut("contour_tree_equals_cut");
    SurfaceChecks surface;
    Context silent = context;  // the parts would run the bar back and forth
    silent.progress = nullptr;
    std::int64_t objects = 0, contours = 0;
    for (std::size_t i = 0; i < isovalues.size(); ++i) {
        context.report("compare", 0, 1, static_cast<double>(i) / static_cast<double>(isovalues.size()));
        const Cut at = cut(volume, isovalues[i], {.interpolant = options.interpolant, .tunnel_height = options.tunnel_height}, silent);
        objects += static_cast<std::int64_t>(at.objects.size());
        contours += static_cast<std::int64_t>(at.contours.size());
        compare_tree_and_cut(analysis, tree, i, at, tree_equals_cut);
        compare_arcs_and_cut(analysis, at, arcs_equal_cut);
        check_surface(volume, at, surface, silent);
    }
    const std::string seen = " at " + std::to_string(isovalues.size()) + " isovalues";
    results.push_back(tree_equals_cut.result(std::to_string(objects) + " objects" + seen));
    results.push_back(arcs_equal_cut.result(std::to_string(contours) + " contours" + seen));
    results.push_back(surface.equals.result(std::to_string(contours) + " contours" + seen));
    if (volume.info.extent.rank == 2) return results;
    const std::string triangles = std::to_string(surface.triangles) + " triangles" + seen;
    for (const Check* check : {&surface.closed, &surface.manifold, &surface.oriented, &surface.no_zero_area})
        results.push_back(check->result(triangles));
    return results;
}

}  // namespace isoatlas
