// The methods that make surfaces are what their papers say, defects included.
#include "isoatlas/surface_methods.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <set>

#include "isoatlas/cell_search.h"
#include "isoatlas/surface_defects.h"
#include "methods/surfaces/contour_stack.h"
#include "oracle/mesh_checks.h"

namespace oracle {
namespace {

using isoatlas::Surface;
using isoatlas::SurfaceMethod;
using isoatlas::SurfaceReport;

isoatlas::Extraction extraction_by(SurfaceMethod method, const isoatlas::Volume& volume, double tau, int divisions = 2) {
    return isoatlas::make_extractor(method, volume, {.divisions = divisions})->extract(tau);
}
Surface extract_by(SurfaceMethod method, const isoatlas::Volume& volume, double tau) { return extraction_by(method, volume, tau).surface; }

SurfaceReport report_of(const Surface& surface) { return isoatlas::inspect(surface.points, surface.triangles); }

/// Enclosed volume of a closed surface: positive when triangles are counter-clockwise seen from outside.
double enclosed(const Surface& surface) {
    double sum = 0;
    for (const auto& t : surface.triangles) {
        const auto &p = surface.points[t[0]], &q = surface.points[t[1]], &r = surface.points[t[2]];
        sum += p[0] * (q[1] * r[2] - q[2] * r[1]) - p[1] * (q[0] * r[2] - q[2] * r[0]) + p[2] * (q[0] * r[1] - q[1] * r[0]);
    }
    return sum / 6;
}

/// A ball in the middle of a grid.
isoatlas::Volume ball(Index size) {
    std::vector<double> values;
    const double middle = static_cast<double>(size - 1) / 2;
    for (Index v = 0; v < size * size * size; ++v) {
        const double x = static_cast<double>(v % size) - middle, y = static_cast<double>(v / size % size) - middle,
                     z = static_cast<double>(v / (size * size)) - middle;
        values.push_back(-std::sqrt(x * x + y * y + z * z));
    }
    return isoatlas::make_volume<double>({3, {size, size, size}}, values);
}

TEST(SurfaceMethods, MakeABall) {
    const isoatlas::Volume volume = ball(24);
    const double exact = 4.0 / 3 * 3.14159265358979 * 9 * 9 * 9;
    for (const isoatlas::SurfaceMethodInfo& info : isoatlas::surface_methods()) {
        EXPECT_EQ(&isoatlas::info_of(info.method), &info);
        if (info.method == SurfaceMethod::connected_contours) continue;  // open where the ball begins and ends
        if (isoatlas::makes_points(info.method)) continue;
        const Surface surface = extract_by(info.method, volume, -9);
        const SurfaceReport report = report_of(surface);
        EXPECT_EQ(report.boundary_edges, 0) << info.name;
        EXPECT_EQ(report.misoriented_edges, 0) << info.name;
        EXPECT_EQ(report.component_chi, std::vector<std::int64_t>{2}) << info.name;
        EXPECT_NEAR(enclosed(surface) / exact, 1, 0.01) << info.name;
    }
}

/// Two cells whose common face alternates: one has three Highs, the other five.
TEST(SurfaceMethods, MarchingCubesHasHoles) {
    std::vector<double> values{0, 1, 0, 1, 0, 1, 0, 0, 1, 0, 1, 1};
    const isoatlas::Volume volume = isoatlas::make_volume<double>({3, {3, 2, 2}}, values);
    const auto holes = [&](SurfaceMethod method) {
        return std::ssize(isoatlas::find_defects(extract_by(method, volume, 0.6), volume.info).hole_edges);
    };
    EXPECT_GT(holes(SurfaceMethod::marching_cubes), 0);
    for (const SurfaceMethod method : {SurfaceMethod::asymptotic_decider, SurfaceMethod::five_tetrahedra, SurfaceMethod::six_tetrahedra,
                                       SurfaceMethod::spider_web, SurfaceMethod::trilinear})
        EXPECT_EQ(holes(method), 0) << isoatlas::info_of(method).name;
}

/// Two Highs at the ends of a diagonal of a cell: the cut joins them, or does not.
TEST(SurfaceMethods, TetrahedraSeeAnotherObjectInAMirror) {
    std::vector<double> values(64, 0.0), mirrored(64, 0.0);
    for (const auto& [x, y, z] : {std::array{1, 1, 1}, std::array{2, 2, 2}}) {
        values[static_cast<std::size_t>(x + 4 * (y + 4 * z))] = 1;
        mirrored[static_cast<std::size_t>(3 - x + 4 * (y + 4 * z))] = 1;
    }
    const auto components = [](SurfaceMethod method, const std::vector<double>& of) {
        return report_of(extract_by(method, isoatlas::make_volume<double>({3, {4, 4, 4}}, of), 0.4)).component_chi.size();
    };
    EXPECT_EQ(components(SurfaceMethod::six_tetrahedra, values), 1U);
    EXPECT_EQ(components(SurfaceMethod::six_tetrahedra, mirrored), 2U);
    EXPECT_EQ(components(SurfaceMethod::trilinear, values), components(SurfaceMethod::trilinear, mirrored));
}

/// Two Highs at the ends of a diagonal of a face, which the tetrahedra of one cell have as an edge and those of the next one do not.
TEST(SurfaceMethods, FiveTetrahedraSeeAnotherObjectOneSampleFurther) {
    const auto components = [](SurfaceMethod method, std::size_t shift) {
        std::vector<double> values(5 * 4 * 4, 0.0);
        for (const std::size_t i : {0, 1}) values[1 + i + shift + 5 * (1 + i + 4 * 1)] = 1;
        return report_of(extract_by(method, isoatlas::make_volume<double>({3, {5, 4, 4}}, values), 0.6)).component_chi.size();
    };
    EXPECT_EQ(components(SurfaceMethod::five_tetrahedra, 0), 1U);
    EXPECT_EQ(components(SurfaceMethod::five_tetrahedra, 1), 2U);
    for (const std::size_t shift : {0, 1}) EXPECT_EQ(components(SurfaceMethod::asymptotic_decider, shift), 2U);
}

RC_GTEST_PROP(SurfaceMethodsOf, AnyVolumeCountWhatTheyLookAt, ()) {
    Grid grid = *arbitrary_grid(4, 40);
    grid.rank = 3;
    const isoatlas::Volume volume = to_volume(grid, arbitrary_type(grid));
    for (const double tau : interesting_values(elements_of(grid, isoatlas::Interpolant::faces))) {
        isoatlas::CellSearchCost brute_force;
        (void)isoatlas::make_cell_search(isoatlas::SearchMethod::brute_force, volume)->active(tau, brute_force);
        for (const isoatlas::SurfaceMethodInfo& info : isoatlas::surface_methods()) {
            if (info.method == SurfaceMethod::connected_contours) continue;  // looks at squares
            const isoatlas::Extraction found = extraction_by(info.method, volume, tau);
            RC_ASSERT(found.cost.cells == brute_force.cells);
            RC_ASSERT(found.cost.active == brute_force.active);
            const auto triangles = found.surface.triangles.size(), points = found.points.points.size();
            RC_ASSERT((isoatlas::makes_points(info.method) ? triangles : points) == 0U);
            RC_ASSERT((found.cost.active == 0) == (triangles + points == 0U));
        }
    }
}

/// A column of that many voxels in the middle, or two that meet half way up.
isoatlas::Volume columns(bool branch) {
    std::vector<double> values;
    for (Index v = 0; v < 20 * 20 * 9; ++v) {
        const double x = static_cast<double>(v % 20), y = static_cast<double>(v / 20 % 20), z = static_cast<double>(v / 400);
        const double apart = branch && z >= 5 ? 4.5 : 0;
        const auto distance = [&](double middle) { return std::hypot(x - middle, y - 9.5); };
        values.push_back(-std::min(distance(9.5 - apart), distance(9.5 + apart)));
    }
    return isoatlas::make_volume<double>({3, {20, 20, 9}}, values);
}

TEST(SurfaceMethods, ContoursConnectOneWithOneAndFailAtBranches) {
    const isoatlas::Volume one = columns(false);
    const Surface tube = extract_by(SurfaceMethod::connected_contours, one, -3.4);
    EXPECT_EQ(std::ssize(isoatlas::find_defects(tube, one.info).hole_edges), 0);
    EXPECT_EQ(report_of(tube).non_manifold_edges, 0);
    EXPECT_EQ(report_of(tube).misoriented_edges, 0);
    EXPECT_EQ(report_of(tube).component_chi, std::vector<std::int64_t>{0});
    EXPECT_NEAR(enclosed(tube) / (8 * 3.14159265 * 3.4 * 3.4), 2.0 / 3, 0.05);  // without its ends, seen from a corner of its axis
    const isoatlas::Volume two = columns(true);
    EXPECT_GT(report_of(extract_by(SurfaceMethod::connected_contours, two, -3.4)).non_manifold_edges, 0);
    EXPECT_EQ(report_of(extract_by(SurfaceMethod::trilinear, two, -3.4)).non_manifold_edges, 0);
    const isoatlas::Volume closed = ball(24);
    EXPECT_GT(std::ssize(isoatlas::find_defects(extract_by(SurfaceMethod::connected_contours, closed, -9), closed.info).hole_edges), 0);
}

/// A comb: a bar in one slice, teeth in the next one. So many teeth get a strip.
TEST(SurfaceMethods, ContoursConnectTheLargestBranches) {
    for (const Index teeth : {isoatlas::kMostBranches - 1, isoatlas::kMostBranches, isoatlas::kMostBranches + 8}) {
        const Index wide = 4 * teeth + 1;
        std::vector<double> values;
        for (Index v = 0; v < wide * 5 * 2; ++v) {
            const Index x = v % wide, y = v / wide % 5, z = v / wide / 5;
            const bool is_bar = z == 0 && x > 0 && x < wide - 1 && y > 0 && y < 4;
            values.push_back(is_bar || (z == 1 && x % 4 == 2 && y == 2) ? 1 : 0);
        }
        const Surface comb = extract_by(SurfaceMethod::connected_contours, isoatlas::make_volume<double>({3, {wide, 5, 2}}, values), 0.5);
        std::set<Index> connected;
        for (const auto& triangle : comb.triangles) {
            for (const Index point : triangle) {
                if (comb.points[point][2] == 1) connected.insert(point);
            }
        }
        EXPECT_EQ(std::ssize(connected), 4 * std::min<Index>(teeth, isoatlas::kMostBranches));
    }
}

/// Half the diagonal of a small cube away from the surface at most, with normals outwards.
TEST(SurfaceMethods, DividingCubesLieNearTheSurface) {
    const isoatlas::Volume volume = ball(24);
    std::size_t before = 0;
    for (const int divisions : {1, 2, 4}) {
        const isoatlas::PointCloud cloud = extraction_by(SurfaceMethod::dividing_cubes, volume, -9, divisions).points;
        const double most = std::sqrt(3) / 2 / divisions + 0.05;  // the interpolated ball is not quite the ball
        for (std::size_t i = 0; i < cloud.points.size(); ++i) {
            double square = 0, along = 0;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double x = cloud.points[i][axis] - 11.5;
                square += x * x, along += x * cloud.normals[i][axis];
            }
            EXPECT_NEAR(std::sqrt(square), 9, most);
            EXPECT_GT(along / std::sqrt(square), 0.95);
        }
        EXPECT_GT(cloud.points.size(), 3 * before);
        before = cloud.points.size();
    }
    EXPECT_THROW((void)extraction_by(SurfaceMethod::dividing_cubes, volume, -9, 0), isoatlas::Error);
}

TEST(SurfaceMethods, RefuseWhatTheyCannot) {
    const isoatlas::Volume image = isoatlas::make_volume<double>({2, {2, 2, 1}}, std::vector<double>{0, 1, 0, 1});
    EXPECT_THROW((void)extract_by(SurfaceMethod::marching_cubes, image, 0.5), isoatlas::Error);
    EXPECT_THROW((void)extract_by(SurfaceMethod::marching_cubes, ball(3), std::nan("")), isoatlas::Error);
}

}  // namespace
}  // namespace oracle
