// verify_mesh: checks that a surface file is a closed oriented manifold.
#include <cmath>

#include "verify/checks.h"

namespace isoatlas {
namespace {

std::string number(std::int64_t count, const char* what) { return std::to_string(count) + " " + what; }

CheckResult indices_are_valid(const Mesh& mesh) {
    Check check("indices_are_valid");
    const auto points = static_cast<std::int64_t>(mesh.points.size());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        for (const std::int64_t point : mesh.triangles[i]) {
            if (point < 0 || point >= points) check.fail("triangle " + std::to_string(i) + " uses point " + std::to_string(point));
        }
    }
    return check.result(number(points, "points"));
}

CheckResult points_are_finite(const Mesh& mesh) {
    Check check("points_are_finite");
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        for (const double coordinate : mesh.points[i]) {
            if (!std::isfinite(coordinate)) check.fail("point " + std::to_string(i));
        }
    }
    return check.result(number(static_cast<std::int64_t>(mesh.points.size()), "points"));
}

CheckResult surface_exists(const Mesh& mesh) {
    const bool exists = !mesh.triangles.empty();
    return {
        "surface_exists", exists,
        exists ? number(static_cast<std::int64_t>(mesh.triangles.size()), "triangles") : "no triangles: empty, or curves of a 2D volume"};
}

CheckResult euler_numbers_are_even(const SurfaceReport& report) {
    Check check("euler_numbers_are_even");  // a closed oriented surface has chi = 2 - 2 genus
    std::int64_t tunnels = 0;
    for (std::size_t i = 0; i < report.component_chi.size(); ++i) {
        const std::int64_t chi = report.component_chi[i];
        if (chi % 2 != 0 || chi > 2) check.fail("component " + std::to_string(i) + " has Euler number " + std::to_string(chi));
        tunnels += (2 - chi) / 2;
    }
    return check.result(number(static_cast<std::int64_t>(report.component_chi.size()), "components") + ", genus " +
                        std::to_string(tunnels) + " in all");
}

}  // namespace

std::vector<CheckResult> verify_mesh(const Mesh& mesh) {
    std::vector<CheckResult> results{surface_exists(mesh), indices_are_valid(mesh), points_are_finite(mesh)};
    if (!results[1].holds) return results;  // no other check is possible
    const SurfaceReport report = inspect(mesh.points, mesh.triangles);
    results.push_back(
        {"surface_is_closed", report.is_closed(),
         number(report.boundary_edges, "open edges") + ", " + number(report.non_manifold_edges, "edges with more than two triangles")});
    results.push_back({"surface_is_manifold", report.is_manifold(),
                       number(report.non_manifold_edges, "bad edges") + ", " + number(report.non_manifold_points, "bad points")});
    results.push_back(
        {"surface_is_oriented", report.is_oriented(), number(report.misoriented_edges, "edges with inconsistent orientation")});
    results.push_back(
        {"surface_has_no_zero_area", report.has_no_zero_area(), number(report.zero_area_triangles, "triangles without area")});
    results.push_back(euler_numbers_are_even(report));
    return results;
}

}  // namespace isoatlas
