// A simplified surface is the exact one with fewer triangles: the same contours, embedded, within the distance, in both directions.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <limits>

#include "isoatlas/level_of_detail.h"
#include "isoatlas/surface.h"
#include "isoatlas/verify.h"
#include "oracle/mesh_checks.h"

namespace oracle {
namespace {

using isoatlas::Boundary;
using isoatlas::DistanceUnit;
using isoatlas::SimplificationOptions;
using isoatlas::Surface;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Case {
    isoatlas::Volume volume;
    Surface exact;
    SimplificationOptions options;

    Case() {
        Grid grid = *arbitrary_grid(9, 400);
        grid.rank = 3;
        const isoatlas::Interpolant interpolant = *arbitrary_interpolant();
        volume = to_volume(grid, arbitrary_type(grid));
        volume.info.geometry = arbitrary_geometry(grid);
        isoatlas::ExtractOptions how;
        how.interpolant = interpolant;
        how.surface.style = *rc::gen::element(isoatlas::SurfaceStyle::compact, isoatlas::SurfaceStyle::full);
        how.surface.boundary = *rc::gen::element(Boundary::closed, Boundary::open);
        exact = isoatlas::extract(volume, arbitrary_tau(elements_of(grid, interpolant)), how);
        options.max_distance = *rc::gen::element(0.05, 0.5, 2.0, kInfinity);
        options.unit = *rc::gen::element(DistanceUnit::voxel, DistanceUnit::physical);
        options.triangles = *rc::gen::element(0, 0, 40);
    }
    [[nodiscard]] isoatlas::SimplifiedSurface simplified(const isoatlas::Context& context = {}) const {
        return isoatlas::simplify_surface(exact, volume.info.geometry, volume.info.extent, options, context);
    }
};

void simplified_surfaces_have_the_same_contours_within_the_distance() {
    const Case c;
    const isoatlas::SimplifiedSurface simplified = c.simplified(arbitrary_context());
    const Surface& surface = simplified.surface;
    RC_ASSERT(surface.triangles.size() <= c.exact.triangles.size());
    RC_ASSERT(surface.normals.size() == surface.points.size());
    RC_ASSERT(surface.object.size() == surface.points.size());
    RC_ASSERT(surface.contour.size() == surface.points.size());
    if (surface.points.empty()) return;
    isoatlas::Mesh mesh;
    mesh.points = surface.points, mesh.triangles = surface.triangles;
    mesh.space = surface.space, mesh.unit = surface.unit;
    isoatlas::SimplifiedOptions how;
    how.max_distance = simplified.distance * (1 + 1e-9) + 1e-12;
    how.in_voxels = c.options.unit == DistanceUnit::voxel;
    if (simplified.distance == 0) how.max_distance = 1e-9;
    for (const isoatlas::CheckResult& check : verify_simplified(mesh, c.exact, c.volume.info, how).checks) {
        if (!check.holds) RC_FAIL(check.name + ": " + check.detail);
    }
}

void simplified_surfaces_keep_the_ids_of_their_contours() {
    const Case c;
    const Surface surface = c.simplified().surface;
    const auto distinct = [](isoatlas::Array<std::int64_t> ids) {
        std::ranges::sort(ids);
        ids.erase(std::ranges::unique(ids).begin(), ids.end());
        return ids;
    };
    RC_ASSERT(distinct(surface.contour) == distinct(c.exact.contour));
    RC_ASSERT(distinct(surface.object) == distinct(c.exact.object));
    for (const auto& triangle : surface.triangles) {
        for (const std::int64_t point : triangle) RC_ASSERT(surface.contour[point] == surface.contour[triangle[0]]);
    }
}

/// A cap is flat before and after: what lies beyond the samples is in one plane, that of the exact surface.
void caps_of_simplified_surfaces_stay_flat() {
    Case c;
    c.volume.info.geometry = {};
    c.options.unit = DistanceUnit::voxel;
    const Surface exact = isoatlas::extract(c.volume, c.exact.tau);
    const Surface surface = isoatlas::simplify_surface(exact, c.volume.info.geometry, c.volume.info.extent, c.options).surface;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto ends = [&](const Surface& of) {
            std::pair<double, double> range{kInfinity, -kInfinity};
            for (const isoatlas::Vec3& p : of.points) range = {std::min(range.first, p[axis]), std::max(range.second, p[axis])};
            return range;
        };
        const auto [low, high] = ends(exact);
        const auto [new_low, new_high] = ends(surface);
        if (low < 0) RC_ASSERT(new_low == low);
        if (high > static_cast<double>(c.volume.info.extent.size[axis] - 1)) RC_ASSERT(new_high == high);
    }
}

void simplified_surfaces_have_the_same_bytes_for_any_threads() {
    const Case c;
    const Surface one = c.simplified({.threads = 1}).surface, two = c.simplified({.threads = 2}).surface;
    RC_ASSERT(one.points == two.points);
    RC_ASSERT(one.triangles == two.triangles);
    RC_ASSERT(one.normals == two.normals);
    RC_ASSERT(one.contour == two.contour);
}

RC_GTEST_PROP(SimplifiedSurfaces, HaveTheSameContoursWithinTheDistance, ()) {
    simplified_surfaces_have_the_same_contours_within_the_distance();
}
RC_GTEST_PROP(SimplifiedSurfaces, KeepTheIdsOfTheirContours, ()) { simplified_surfaces_keep_the_ids_of_their_contours(); }
RC_GTEST_PROP(SimplifiedSurfaces, KeepCapsFlat, ()) { caps_of_simplified_surfaces_stay_flat(); }
RC_GTEST_PROP(SimplifiedSurfaces, HaveTheSameBytesForAnyThreads, ()) { simplified_surfaces_have_the_same_bytes_for_any_threads(); }

}  // namespace
}  // namespace oracle
