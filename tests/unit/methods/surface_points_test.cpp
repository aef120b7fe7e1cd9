// A surface as points: those of Dividing Cubes in the cells that it passes through.
#include "isoatlas/surface_points.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "isoatlas/phantom.h"
#include "oracle/mesh_checks.h"

namespace oracle {
namespace {

using isoatlas::PointCloud;
using isoatlas::Surface;
using isoatlas::Vec3;

PointCloud dividing_cubes(const isoatlas::Volume& volume, double tau, int divisions) {
    return isoatlas::make_extractor(isoatlas::SurfaceMethod::dividing_cubes, volume, {.divisions = divisions})->extract(tau).points;
}

std::vector<Vec3> sorted(const isoatlas::Array<Vec3>& points) {
    std::vector<Vec3> result(points.begin(), points.end());
    std::sort(result.begin(), result.end());
    return result;
}

Vec3 minus(const Vec3& p, const Vec3& q) { return {p[0] - q[0], p[1] - q[1], p[2] - q[2]}; }
Vec3 cross(const Vec3& p, const Vec3& q) { return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]}; }

/// Of all objects together the points are those of Dividing Cubes, whatever the surface was made from; of one they are a part of them.
RC_GTEST_PROP(SurfacePoints, AreThoseOfTheCellsThatTheSurfacePasses, ()) {
    const Grid grid = *arbitrary_grid(7, 200);
    RC_PRE(grid.rank == 3 && std::min({grid.size[0], grid.size[1], grid.size[2]}) > 1);
    const isoatlas::Volume volume = to_volume(grid, arbitrary_type(grid));
    const double tau = grid.value[grid.value.size() / 2] - 0.25;  // between samples
    const int divisions = *rc::gen::inRange(1, 4);
    const PointCloud all = dividing_cubes(volume, tau, divisions);
    const Surface surface = isoatlas::extract(volume, tau, {.interpolant = isoatlas::Interpolant::trilinear});
    const PointCloud cloud = isoatlas::points_of_surface(volume, surface, divisions);
    RC_ASSERT(cloud.points == all.points);
    RC_ASSERT(cloud.normals == all.normals);
    const isoatlas::SampleBox box = isoatlas::samples_around(volume.info, surface);
    RC_ASSERT(isoatlas::points_of_surface(isoatlas::crop(volume, box), surface, divisions).points.size() == all.points.size());
    if (surface.triangles.empty()) return;
    isoatlas::ExtractOptions one{.interpolant = isoatlas::Interpolant::trilinear};
    one.surface.objects = {surface.object[static_cast<std::size_t>(surface.triangles[0][0])]};
    const PointCloud part = isoatlas::points_of_surface(volume, isoatlas::extract(volume, tau, one), divisions);
    RC_ASSERT(std::ranges::includes(sorted(all.points), sorted(part.points)));
}

TEST(SurfacePoints, BecomeSquaresThatFaceAlongTheirNormals) {
    const PointCloud cloud = dividing_cubes(isoatlas::make_phantom("random-field", {.size = 12}), 0, 2);
    const Surface squares = isoatlas::as_squares(cloud, 0.5);
    ASSERT_EQ(squares.triangles.size(), 2 * cloud.points.size());
    for (std::size_t i = 0; i < squares.triangles.size(); ++i) {
        const auto& t = squares.triangles[i];
        const Vec3 across = minus(squares.points[t[1]], squares.points[t[0]]), up = minus(squares.points[t[2]], squares.points[t[0]]);
        const Vec3 area = cross(across, up);
        const auto& n = cloud.normals[i / 2];
        EXPECT_NEAR(area[0] * n[0] + area[1] * n[1] + area[2] * n[2], 1, 1e-5);  // twice half of a square of side 1
    }
}

}  // namespace
}  // namespace oracle
