// The surface is a closed, oriented, embedded 2-manifold whose pieces are the contours of the cut. Here 3D; 2D in mesh_2d_test.cpp.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "isoatlas/cut.h"
#include "isoatlas/surface.h"
#include "oracle/mesh_checks.h"

namespace oracle {
namespace {

using isoatlas::Boundary;
using isoatlas::Shell;
using isoatlas::ShellChoice;
using isoatlas::Surface;
using isoatlas::SurfaceReport;
using isoatlas::SurfaceStyle;

struct Case {
    Grid grid;
    isoatlas::Interpolant interpolant;
    Elements elements;
    isoatlas::Volume volume;
    double tau;
    explicit Case(Grid g)
        : grid(std::move(g)),
          interpolant(*arbitrary_interpolant()),
          elements(elements_of(grid, interpolant)),
          volume(to_volume(grid, arbitrary_type(grid))),
          tau(arbitrary_tau(elements)) {}

    isoatlas::ExtractOptions arbitrary_style() const {
        isoatlas::ExtractOptions options;
        options.interpolant = interpolant;
        options.surface.style = *rc::gen::element(SurfaceStyle::compact, SurfaceStyle::full);
        return options;
    }
    isoatlas::Cut cut(bool label = false) const { return isoatlas::cut(volume, tau, {.interpolant = interpolant, .label = label}); }
};

Grid arbitrary_grid_3d() {
    Grid grid = *arbitrary_grid();
    grid.rank = 3;
    return grid;
}

void mesh_is_a_closed_oriented_manifold() {
    Case c(arbitrary_grid_3d());
    c.volume.info.geometry = arbitrary_geometry(c.grid);
    const Surface surface = isoatlas::extract(c.volume, c.tau, c.arbitrary_style(), arbitrary_context());
    const SurfaceReport report = isoatlas::inspect(surface.points, surface.triangles);
    RC_ASSERT(report.is_closed());
    RC_ASSERT(report.is_manifold());
    RC_ASSERT(report.is_oriented());
    RC_ASSERT(report.has_no_zero_area());
    RC_ASSERT(report.unused_points == 0);
    RC_ASSERT(report.coincident_points == 0);
    RC_ASSERT(surface.normals.size() == surface.points.size());
    for (const auto& n : surface.normals) RC_ASSERT(std::abs(std::hypot(n[0], n[1], n[2]) - 1) < 1e-5);
}

// Components, Euler numbers and ids of the mesh are those of the cut.
void mesh_pieces_are_the_contours_of_the_cut() {
    const Case c(arbitrary_grid_3d());
    const Surface surface = isoatlas::extract(c.volume, c.tau, c.arbitrary_style(), arbitrary_context());
    const isoatlas::Cut cut = c.cut();
    std::map<Index, Index> points, triangles;
    for (const Index contour : surface.contour) ++points[contour];
    for (const auto& t : surface.triangles) {
        RC_ASSERT(surface.contour[t[0]] == surface.contour[t[1]] && surface.contour[t[0]] == surface.contour[t[2]]);
        ++triangles[surface.contour[t[0]]];
    }
    std::map<Index, Index> object_of;
    for (const isoatlas::CutContour& contour : cut.contours) {
        object_of[contour.id] = contour.object;
        RC_ASSERT(triangles[contour.id] > 0);
        RC_ASSERT(points[contour.id] - triangles[contour.id] / 2 == 2 - 2 * contour.genus);  // closed: 3 triangles are 2 edges
    }
    RC_ASSERT(points.size() == cut.contours.size());
    for (std::size_t i = 0; i < surface.points.size(); ++i) RC_ASSERT(object_of.at(surface.contour[i]) == surface.object[i]);
    const SurfaceReport report = isoatlas::inspect(surface.points, surface.triangles);
    RC_ASSERT(report.component_chi.size() == cut.contours.size());  // so every contour is connected
}

void mesh_outer_contours_enclose_cavities_are_hollow() {
    Case c(arbitrary_grid_3d());
    c.volume.info.geometry = arbitrary_geometry(c.grid);
    const Surface surface = isoatlas::extract(c.volume, c.tau, c.arbitrary_style());
    std::map<Index, double> volume = signed_volumes(surface);
    for (const isoatlas::CutContour& contour : c.cut().contours) {
        RC_ASSERT((contour.shell == Shell::outer ? volume[contour.id] : -volume[contour.id]) > 0);
    }
}

/// Euler number of the High set on the border of the box: corners - edges + faces of the border squares
/// (docs/theory/5-surfaces.md#the-border-of-the-volume).
Index chi_on_the_border(const Case& c) {
    const Snapshot shot = snapshot(c.elements, c.elements.cut_at(c.tau));
    const auto high = [&](Index e) { return shot.object_of[e] >= 0; };
    Index chi = 0;
    for (Index v = 0; v < c.grid.voxels(); ++v) {
        const std::array<Index, 3> p = c.grid.voxel(v);
        std::array<bool, 3> edge_of_box{};
        for (int a = 0; a < 3; ++a) edge_of_box[a] = p[a] == 0 || p[a] == c.grid.size[a] - 1;
        if (high(v)) chi += edge_of_box[0] || edge_of_box[1] || edge_of_box[2];
        for (int a = 0; a < 3; ++a) {
            const Index next = c.grid.neighbour(v, 2 * a + 1);
            if (next >= 0 && (edge_of_box[(a + 1) % 3] || edge_of_box[(a + 2) % 3]) && high(v) && high(next)) --chi;
        }
        for (int o = 0; o < 3; ++o) {  // xy, xz, yz
            const int first = o == 2 ? 1 : 0, second = o == 0 ? 1 : 2, normal = 2 - o;
            if (!edge_of_box[normal] || p[first] + 1 >= c.grid.size[first] || p[second] + 1 >= c.grid.size[second]) continue;
            const Index b = c.grid.neighbour(v, 2 * first + 1), d = c.grid.neighbour(v, 2 * second + 1);
            const Index far = c.grid.neighbour(b, 2 * second + 1);
            const int lows = !high(v) + !high(b) + !high(far) + !high(d);
            if (lows == 0) ++chi;
            const bool split = lows == 2 && high(v) == high(far);
            if (split && high(c.elements.face_at[3 * v + o])) --chi;  // two low components
        }
    }
    return chi;
}

void mesh_open_surfaces_end_at_the_border_of_the_volume() {
    const Case c(arbitrary_grid_3d());
    isoatlas::ExtractOptions how = c.arbitrary_style();
    isoatlas::SurfaceOptions& options = how.surface;
    options.boundary = Boundary::open;
    const Surface surface = isoatlas::extract(c.volume, c.tau, how, arbitrary_context());
    RC_ASSERT(!surface.closed);
    if (*std::min_element(c.grid.size.begin(), c.grid.size.end()) == 1) {
        RC_ASSERT(surface.points.empty() && surface.triangles.empty());
        return;
    }
    const SurfaceReport report = isoatlas::inspect(surface.points, surface.triangles);
    RC_ASSERT(report.is_manifold() && report.is_oriented() && report.has_no_zero_area());
    RC_ASSERT(report.unused_points == 0);
    std::map<std::pair<Index, Index>, int> sides;
    for (const auto& t : surface.triangles) {
        for (int i = 0; i < 3; ++i) ++sides[std::minmax(t[i], t[(i + 1) % 3])];
    }
    Index boundary = 0;
    for (const auto& [edge, count] : sides) {
        if (count != 1) continue;
        ++boundary;
        const isoatlas::Vec3 &p = surface.points[edge.first], &q = surface.points[edge.second];
        bool on_border = false;
        for (int a = 0; a < 3; ++a) on_border |= p[a] == q[a] && (p[a] == 0 || p[a] == static_cast<double>(c.grid.size[a] - 1));
        RC_ASSERT(on_border);
    }
    RC_ASSERT(boundary == report.boundary_edges);
    Index chi_high = 0;
    for (const isoatlas::CutObject& object : c.cut().objects) chi_high += object.chi;
    const Index chi = std::accumulate(report.component_chi.begin(), report.component_chi.end(), Index{0});
    RC_ASSERT(chi == 2 * chi_high - chi_on_the_border(c));
}

/// The triangles of a surface whose contour is wanted, by coordinates.
template <class Wanted>
std::vector<std::array<isoatlas::Vec3, 3>> triangles_of(const Surface& surface, Wanted&& wanted) {
    std::vector<std::array<isoatlas::Vec3, 3>> list;
    for (const auto& t : surface.triangles) {
        if (wanted(static_cast<std::size_t>(t[0]))) list.push_back({surface.points[t[0]], surface.points[t[1]], surface.points[t[2]]});
    }
    return list;
}

void mesh_selections_are_subsets() {
    const Case c(arbitrary_grid_3d());
    isoatlas::ExtractOptions how = c.arbitrary_style();
    isoatlas::SurfaceOptions& options = how.surface;
    options.boundary = *rc::gen::element(Boundary::closed, Boundary::open);
    const Surface whole = isoatlas::extract(c.volume, c.tau, how);
    const isoatlas::Cut cut = c.cut(true);
    RC_PRE(!cut.objects.empty());
    std::map<Index, Shell> shell_of;
    for (const isoatlas::CutContour& contour : cut.contours) shell_of[contour.id] = contour.shell;

    const auto& object = cut.objects[*rc::gen::inRange<std::size_t>(0, cut.objects.size())];
    const auto& contour = cut.contours[*rc::gen::inRange<std::size_t>(0, cut.contours.size())];
    const auto everywhere = [](const Surface& s) { return triangles_of(s, [](std::size_t) { return true; }); };
    const Index position = &object - cut.objects.data();
    for (Index v = 0; v < c.grid.voxels(); ++v) {  // any voxel of the object names it
        if (cut.label[v] != position) continue;
        options.objects = {v};
        break;
    }
    const Surface one = isoatlas::extract(c.volume, c.tau, how, arbitrary_context());
    RC_ASSERT(everywhere(one) == triangles_of(whole, [&](std::size_t i) { return whole.object[i] == object.id; }));
    RC_ASSERT(isoatlas::inspect(one.points, one.triangles).unused_points == 0);
    RC_ASSERT(one.normals.size() == one.points.size() && one.object.size() == one.points.size());
    options.shell = ShellChoice::inner;
    RC_ASSERT(everywhere(isoatlas::extract(c.volume, c.tau, how)) == triangles_of(whole, [&](std::size_t i) {
                  return whole.object[i] == object.id && shell_of[whole.contour[i]] == Shell::inner;
              }));
    options.objects.clear();
    options.shell = ShellChoice::outer;
    RC_ASSERT(everywhere(isoatlas::extract(c.volume, c.tau, how)) ==
              triangles_of(whole, [&](std::size_t i) { return shell_of[whole.contour[i]] == Shell::outer; }));
    options.shell = ShellChoice::all;
    options.contours = {contour.id};
    options.ids = false;
    const Surface wall = isoatlas::extract(c.volume, c.tau, how);
    RC_ASSERT(everywhere(wall) == triangles_of(whole, [&](std::size_t i) { return whole.contour[i] == contour.id; }));
    RC_ASSERT(wall.object.empty() && wall.contour.empty());
}

void mesh_has_the_same_bytes_for_any_threads_and_slabs() {
    Case c(*arbitrary_grid(7, 200));
    c.volume.info.geometry = arbitrary_geometry(c.grid);
    isoatlas::ExtractOptions how = c.arbitrary_style();
    isoatlas::SurfaceOptions& options = how.surface;
    options.boundary = *rc::gen::element(Boundary::closed, Boundary::open);
    isoatlas::Context one_thread;
    one_thread.threads = 1;
    const Surface expected = isoatlas::extract(c.volume, c.tau, how, one_thread);
    for (int i = 0; i < 3; ++i) {
        const Surface actual = isoatlas::extract(c.volume, c.tau, how, arbitrary_context());
        RC_ASSERT(actual.points == expected.points && actual.normals == expected.normals);
        RC_ASSERT(actual.triangles == expected.triangles && actual.segments == expected.segments);
        RC_ASSERT(actual.object == expected.object && actual.contour == expected.contour);
    }
}

// Hits in the middle of edges and close to their ends; cells full of ambiguous faces.
void mesh_no_two_triangles_cross() {
    const std::array<Index, 3> size{2, 2, *rc::gen::inRange<Index>(2, 4)};
    Grid grid{3, size, {}};
    const bool spread = *rc::gen::inRange(0, 2) == 1;
    for (Index v = 0; v < grid.voxels(); ++v) {
        const double sign = *rc::gen::inRange(0, 2) == 1 ? 1 : -1;
        const int size_of_value = *rc::gen::inRange(0, 100);
        grid.value.push_back(sign * (spread ? std::pow(1.15, size_of_value - 50) : 1 + size_of_value / 20.0));
    }
    isoatlas::ExtractOptions options;
    options.interpolant = *arbitrary_interpolant();
    options.surface.style = *rc::gen::element(SurfaceStyle::compact, SurfaceStyle::full);
    options.surface.boundary = *rc::gen::element(Boundary::closed, Boundary::open);
    RC_ASSERT(count_crossings(isoatlas::extract(to_volume(grid), 0, options)) == 0);
}

RC_GTEST_PROP(Mesh, IsAClosedOrientedManifold, ()) { mesh_is_a_closed_oriented_manifold(); }
RC_GTEST_PROP(Mesh, PiecesAreTheContoursOfTheCut, ()) { mesh_pieces_are_the_contours_of_the_cut(); }
RC_GTEST_PROP(Mesh, OuterContoursEncloseCavitiesAreHollow, ()) { mesh_outer_contours_enclose_cavities_are_hollow(); }
RC_GTEST_PROP(Mesh, OpenSurfacesEndAtTheBorderOfTheVolume, ()) { mesh_open_surfaces_end_at_the_border_of_the_volume(); }
RC_GTEST_PROP(Mesh, SelectionsAreSubsets, ()) { mesh_selections_are_subsets(); }
RC_GTEST_PROP(Mesh, HasTheSameBytesForAnyThreadsAndSlabs, ()) { mesh_has_the_same_bytes_for_any_threads_and_slabs(); }
RC_GTEST_PROP(Mesh, NoTwoTrianglesCross, ()) { mesh_no_two_triangles_cross(); }

}  // namespace
}  // namespace oracle
