#include "cgal_collapse.h"

#include <stdexcept>

#ifdef ISOATLAS_WITH_CGAL
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/polygon_mesh_to_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_filter.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_placement.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Polyhedral_envelope_filter.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <vector>

#include "command_line.h"

namespace bench {
namespace {

namespace simplification = CGAL::Surface_mesh_simplification;
namespace processing = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Polygons = std::vector<std::vector<std::size_t>>;

SurfaceMesh surface_mesh(const isoatlas::Mesh& mesh) {
    std::vector<Kernel::Point_3> points;
    for (const auto& p : mesh.points) points.emplace_back(p[0], p[1], p[2]);
    Polygons polygons;
    for (const auto& t : mesh.triangles)
        polygons.push_back({static_cast<std::size_t>(t[0]), static_cast<std::size_t>(t[1]), static_cast<std::size_t>(t[2])});
    if (!processing::is_polygon_soup_a_polygon_mesh(polygons)) throw std::runtime_error("the mesh is no manifold");
    SurfaceMesh result;
    processing::polygon_soup_to_polygon_mesh(points, polygons, result);
    return result;
}

isoatlas::Surface surface_of(const SurfaceMesh& mesh) {
    std::vector<Kernel::Point_3> points;
    Polygons polygons;
    processing::polygon_mesh_to_polygon_soup(mesh, points, polygons);
    isoatlas::Surface surface;
    for (const Kernel::Point_3& p : points) surface.points.push_back({p.x(), p.y(), p.z()});
    for (const std::vector<std::size_t>& t : polygons)
        surface.triangles.push_back({static_cast<std::int64_t>(t[0]), static_cast<std::int64_t>(t[1]), static_cast<std::int64_t>(t[2])});
    return surface;
}

template <class Filter>
void collapse(SurfaceMesh& mesh, std::int64_t triangles, const Filter& filter) {
    const simplification::Count_stop_predicate<SurfaceMesh> stop(static_cast<std::size_t>(triangles * 3 / 2));  // edges
    simplification::edge_collapse(mesh, stop,
                                  CGAL::parameters::get_cost(simplification::LindstromTurk_cost<SurfaceMesh>())
                                      .get_placement(simplification::LindstromTurk_placement<SurfaceMesh>())
                                      .filter(filter));
}

}  // namespace

Collapsed collapse_with_cgal(const isoatlas::Mesh& mesh, double error, std::int64_t triangles) {
    SurfaceMesh collapsed = surface_mesh(mesh);
    using Turning = simplification::Bounded_normal_change_filter<>;
    using Enveloped = simplification::Polyhedral_envelope_filter<Kernel, Turning>;
    Collapsed result;
    result.seconds = seconds_of([&] {
        if (error > 0)
            collapse(collapsed, triangles, Enveloped(error, Turning()));
        else
            collapse(collapsed, triangles, Turning());
    });
    result.surface = surface_of(collapsed);
    return result;
}

}  // namespace bench

#else

namespace bench {

Collapsed collapse_with_cgal(const isoatlas::Mesh& /*mesh*/, double /*error*/, std::int64_t /*triangles*/) {
    throw std::runtime_error("built without CGAL: install libcgal-dev");
}

}  // namespace bench

#endif
