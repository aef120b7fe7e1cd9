// What is wrong with a surface is found where it is.
#include "isoatlas/surface_defects.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <numeric>
#include <set>

#include "isoatlas/cut.h"
#include "isoatlas/surface_methods.h"
#include "oracle/mesh_checks.h"

namespace oracle {
namespace {

using isoatlas::ComponentDifference;
using isoatlas::Surface;
using isoatlas::SurfaceMethod;

Surface surface_by(SurfaceMethod method, const isoatlas::Volume& volume, double tau) {
    return isoatlas::make_extractor(method, volume)->extract(tau).surface;
}

/// The edge between neighbouring samples that a point of a grid without geometry lies inside: its lower end, and the axis; else axis -1.
std::array<Index, 4> edge_at(const isoatlas::Vec3& point) {
    std::array<Index, 4> edge{0, 0, 0, -1};
    int between = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        edge[axis] = static_cast<Index>(std::floor(point[axis] + 1e-6));
        if (point[axis] - static_cast<double>(edge[axis]) > 1e-6) ++between, edge[3] = static_cast<Index>(axis);
    }
    if (between != 1) edge[3] = -1;
    return edge;
}

/// The edges that each component crosses, of those in `among`; components by flooding.
std::multiset<std::set<std::array<Index, 4>>> crossed(const Surface& surface, const std::set<std::array<Index, 4>>& among) {
    std::vector<std::int64_t> label(surface.points.size());
    for (std::size_t i = 0; i < label.size(); ++i) label[i] = static_cast<std::int64_t>(i);
    for (bool changed = true; changed;) {
        changed = false;
        for (const auto& t : surface.triangles) {
            const std::int64_t low = std::min({label[t[0]], label[t[1]], label[t[2]]});
            for (const std::int64_t point : t) changed = changed || label[point] != low, label[point] = low;
        }
    }
    std::map<std::int64_t, std::set<std::array<Index, 4>>> edges;
    for (const auto& t : surface.triangles) {
        for (const std::int64_t point : t) {
            const auto edge = edge_at(surface.points[point]);
            if (edge[3] >= 0) edges[label[point]];
            if (among.contains(edge)) edges[label[point]].insert(edge);
        }
    }
    std::multiset<std::set<std::array<Index, 4>>> all;
    for (const auto& [number, of_component] : edges) all.insert(of_component);
    return all;
}

std::set<std::array<Index, 4>> all_edges(const Surface& surface) {
    std::set<std::array<Index, 4>> edges;
    for (const auto& t : surface.triangles) {
        for (const std::int64_t point : t) {
            if (edge_at(surface.points[point])[3] >= 0) edges.insert(edge_at(surface.points[point]));
        }
    }
    return edges;
}

/// Components that cross the edges of none of the reference, among the edges that both cross.
std::int64_t wrong_ones(const Surface& surface, const Surface& reference) {
    const auto own = all_edges(surface), wanted = all_edges(reference);
    std::set<std::array<Index, 4>> both;
    std::ranges::set_intersection(own, wanted, std::inserter(both, both.end()));
    const auto right = crossed(reference, both);
    std::int64_t wrong = 0;
    for (const auto& edges : crossed(surface, both)) wrong += edges.empty() || right.count(edges) != 1;
    return wrong;
}

RC_GTEST_PROP(SurfaceDefects, AreThoseThatAreCounted, ()) {
    Grid grid = *arbitrary_grid(4, 40);
    grid.rank = 3;
    const isoatlas::Volume volume = to_volume(grid, arbitrary_type(grid));
    const std::vector<double> taus = interesting_values(elements_of(grid, isoatlas::Interpolant::faces));
    const double tau = taus[*rc::gen::inRange<std::size_t>(0, taus.size())];
    const Surface reference = surface_by(SurfaceMethod::trilinear, volume, tau);
    for (const isoatlas::SurfaceMethodInfo& info : isoatlas::surface_methods()) {
        if (isoatlas::makes_points(info.method)) continue;
        const Surface surface = surface_by(info.method, volume, tau);
        const isoatlas::SurfaceReport report = isoatlas::inspect(surface.points, surface.triangles);
        const isoatlas::SurfaceDefects defects = isoatlas::find_defects(surface, volume.info);
        RC_ASSERT(std::ssize(defects.non_manifold_edges) == report.non_manifold_edges);
        RC_ASSERT(std::ssize(defects.zero_area_triangles) == report.zero_area_triangles);
        RC_ASSERT(std::ssize(defects.hole_edges) <= report.boundary_edges);
        RC_ASSERT(defects.components == std::ssize(report.component_chi));
        RC_ASSERT(defects.euler == std::accumulate(report.component_chi.begin(), report.component_chi.end(), std::int64_t{0}));
        const ComponentDifference same = isoatlas::compare_components(surface, surface, volume.info);
        RC_ASSERT(same.components == std::ssize(report.component_chi));
        const bool is_generic = std::ranges::find(grid.value, tau) == grid.value.end();
        if (!is_generic) continue;                                               // points on samples
        const bool is_exact = info.method != SurfaceMethod::connected_contours;  // which run along edges in the end of the volume
        if (is_exact && same.wrong != 0) RC_FAIL(std::string(info.name) + " at " + std::to_string(tau) + ": differs from itself");
        RC_ASSERT(!is_exact || same.misplaced_triangles.empty());
        const ComponentDifference difference = isoatlas::compare_components(surface, reference, volume.info);
        RC_ASSERT(difference.wrong == wrong_ones(surface, reference));
        RC_ASSERT(difference.wrong > 0 || difference.misplaced_triangles.empty());
    }
}

/// Two Highs at the ends of a diagonal of a cell: six tetrahedra join them.
std::optional<std::int64_t> genus_by(SurfaceMethod method, const isoatlas::Volume& volume, double tau) {
    const Surface surface = surface_by(method, volume, tau);
    return isoatlas::genus_of(isoatlas::find_defects(surface, volume.info));
}

/// With Lows all around, surfaces are closed: genera are those of the contours.
RC_GTEST_PROP(SurfaceDefects, GeneraAreThoseOfTheContours, ()) {
    Grid grid = *arbitrary_grid(8, 300);
    RC_PRE(grid.rank == 3);
    const double lowest = *std::min_element(grid.value.begin(), grid.value.end());
    for (Index v = 0; v < std::ssize(grid.value); ++v) {
        const std::array<Index, 3> at{v % grid.size[0], v / grid.size[0] % grid.size[1], v / (grid.size[0] * grid.size[1])};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (at[axis] == 0 || at[axis] == grid.size[axis] - 1) grid.value[v] = lowest;
        }
    }
    const isoatlas::Volume volume = to_volume(grid, isoatlas::ValueType::f64);
    const double tau = grid.value[grid.value.size() / 2] + 0.25;
    std::int64_t expected = 0;
    for (const isoatlas::CutContour& contour : isoatlas::cut(volume, tau).contours) expected += contour.genus;
    RC_ASSERT(genus_by(SurfaceMethod::trilinear, volume, tau) == expected);
}

TEST(SurfaceDefects, RimsAreClosedByDisks) {
    std::vector<double> column, tunnel;  // along z, through both ends; and with a hole from side to side
    for (Index v = 0; v < 8 * 8 * 8; ++v) {
        const Index x = v % 8, y = v / 8 % 8, z = v / 64;
        const bool is_column = x > 1 && x < 6 && y > 1 && y < 6;
        column.push_back(is_column ? 1 : 0);
        tunnel.push_back(is_column && (y < 3 || y > 4 || z < 3 || z > 4) ? 1 : 0);
    }
    const auto volume = [](const std::vector<double>& values) { return isoatlas::make_volume<double>({3, {8, 8, 8}}, values); };
    for (const SurfaceMethod method : {SurfaceMethod::marching_cubes, SurfaceMethod::six_tetrahedra, SurfaceMethod::trilinear}) {
        EXPECT_EQ(genus_by(method, volume(column), 0.5), 0);
        EXPECT_EQ(genus_by(method, volume(tunnel), 0.5), 1);
    }
    Surface fin = surface_by(SurfaceMethod::trilinear, volume(column), 0.5);  // two more triangles at an edge
    for (const double far : {-1.0, -2.0}) {
        fin.points.push_back({far, far, far});
        fin.triangles.push_back({fin.triangles[0][0], fin.triangles[0][1], std::ssize(fin.points) - 1});
    }
    EXPECT_EQ(isoatlas::genus_of(isoatlas::find_defects(fin, volume(column).info)), std::nullopt);
}

TEST(SurfaceDefects, ComponentsThatAreJoinedAreWrong) {
    std::vector<double> values(64, 0.0);
    values[1 + 4 * (1 + 4 * 1)] = values[2 + 4 * (2 + 4 * 2)] = 1;
    const isoatlas::Volume volume = isoatlas::make_volume<double>({3, {4, 4, 4}}, values);
    const Surface reference = surface_by(SurfaceMethod::trilinear, volume, 0.4);
    const Surface joined = surface_by(SurfaceMethod::six_tetrahedra, volume, 0.4);
    const ComponentDifference difference = isoatlas::compare_components(joined, reference, volume.info);
    EXPECT_EQ(difference.components, 1);
    EXPECT_EQ(difference.wrong, 1);
    EXPECT_GT(difference.misplaced_triangles.size(), 0U);
    EXPECT_LT(difference.misplaced_triangles.size(), joined.triangles.size());  // one of both Highs stays what it is
    EXPECT_TRUE(std::ranges::is_sorted(difference.misplaced_triangles));
    const ComponentDifference split = isoatlas::compare_components(reference, joined, volume.info);  // the other way round
    EXPECT_EQ(split.components, 2);
    EXPECT_EQ(split.wrong, 2);
}

/// Where points lie does not matter: spacings, turned axes and uneven steps.
TEST(SurfaceDefects, AreSeenInAnyGeometry) {
    std::vector<double> values{0, 1, 0, 1, 0, 1, 0, 0, 1, 0, 1, 1};
    isoatlas::Volume volume = isoatlas::make_volume<double>({3, {3, 2, 2}}, values);
    const auto defects_of = [&] { return isoatlas::find_defects(surface_by(SurfaceMethod::marching_cubes, volume, 0.6), volume.info); };
    const std::size_t holes = defects_of().hole_edges.size();
    EXPECT_GT(holes, 0U);
    volume.info.geometry.spacing = {0.3, 20, 1};
    volume.info.geometry.origin = {-7, 1e4, 3};
    volume.info.geometry.direction = {{{0, 0.8, -0.6}, {1, 0, 0}, {0, 0.6, 0.8}}};
    EXPECT_EQ(defects_of().hole_edges.size(), holes);
    volume.info.geometry.coordinates = {{{0, 1, 7}, {2, 3}, {-1, 4}}};
    EXPECT_EQ(defects_of().hole_edges.size(), holes);
    const Surface surface = surface_by(SurfaceMethod::trilinear, volume, 0.6);
    EXPECT_EQ(isoatlas::compare_components(surface, surface, volume.info).wrong, 0);
}

}  // namespace
}  // namespace oracle
