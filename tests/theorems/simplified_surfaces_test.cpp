// A simplified surface is the exact one with fewer triangles: the same contours, embedded, within the distance, in both directions.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <sstream>

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
    /// What a failure is to say.
    [[nodiscard]] std::string text(const isoatlas::SimplifiedReport& report) const {
        std::ostringstream out;
        out << (exact.closed ? "; closed" : "; open") << (options.unit == DistanceUnit::voxel ? ", voxels, " : ", lengths, ")
            << (volume.info.geometry.coordinates[0].empty() ? "even" : "uneven") << " axes, " << exact.triangles.size()
            << " triangles; to exact, back: " << report.to_exact.upper << ", " << report.from_exact.upper << "; in voxels "
            << report.to_exact_in_voxels.upper << ", " << report.from_exact_in_voxels.upper;
        return out.str();
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
    how.max_distance = simplified.distance * (1 + 1e-5);
    how.in_voxels = c.options.unit == DistanceUnit::voxel;
    if (simplified.distance == 0) how.max_distance = 1e-9;
    const isoatlas::SimplifiedReport report = verify_simplified(mesh, c.exact, c.volume.info, how);
    for (const isoatlas::CheckResult& check : report.checks) {
        if (!check.holds) RC_FAIL(check.name + ": " + check.detail + c.text(report));
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

/// Volumes of several blocks, of shapes that decimators break.
struct Shape {
    const char* name;
    isoatlas::Extent extent;
    double (*sample)(double x, double y, double z);
    double tau;
};

double hashed(double x, double y, double z) {
    std::uint64_t bits = static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15U ^ static_cast<std::uint64_t>(y) * 0xc2b2ae3d27d4eb4fU ^
                         static_cast<std::uint64_t>(z) * 0x165667b19e3779f9U;
    bits = (bits ^ bits >> 31) * 0xbf58476d1ce4e5b9U;
    return static_cast<double>((bits ^ bits >> 29) >> 11) * 0x1p-53;
}

const Shape kShapes[] = {
    {"the tube of the dissertation's condition",
     {3, {5, 5, 9}},
     [](double x, double y, double z) { return 10 - 5 * (std::abs(x - 2) + std::abs(y - 2)) - 0.01 * z; },
     7},
    {"a tube of one voxel through many blocks",
     {3, {140, 9, 9}},
     [](double x, double y, double z) {
         const double u = y - 4 - 2 * std::sin(x / 9), v = z - 4 - 2 * std::cos(x / 9);
         return 1.2 - std::sqrt(u * u + v * v);
     },
     0.5},
    {"sheets one voxel apart",
     {3, {40, 34, 9}},
     [](double x, double y, double z) { return std::sin(3.14159 * (z + 0.3 * std::sin(x / 7) + 0.3 * std::cos(y / 5))); },
     0.1},
    {"nested shells a voxel thin",
     {3, {34, 34, 34}},
     [](double x, double y, double z) {
         const double r = std::sqrt((x - 17) * (x - 17) + (y - 17.3) * (y - 17.3) + (z - 16.8) * (z - 16.8));
         return std::sin(3.14159 * r / 1.3);
     },
     0.2},
    {"noise", {3, {40, 34, 8}}, [](double x, double y, double z) { return hashed(x, y, z); }, 0.6},
    {"a smooth surface",
     {3, {40, 40, 30}},
     [](double x, double y, double z) { return std::sin(x / 6) * std::cos(y / 7) + std::sin(z / 5) * std::cos(x / 9); },
     0.3},
};

isoatlas::Volume volume_of(const Shape& shape) {
    std::vector<float> samples;
    for (std::int64_t i = 0; i < shape.extent.voxels(); ++i) {
        const auto p = shape.extent.voxel(i);
        samples.push_back(
            static_cast<float>(shape.sample(static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2]))));
    }
    isoatlas::Volume volume = isoatlas::make_volume<float>(shape.extent, samples);
    volume.info.geometry.spacing = {0.7, 1.1, 2.5};
    volume.info.geometry.origin = {-100, 37, 5};
    const double c = std::cos(0.4), s = std::sin(0.4);
    volume.info.geometry.direction = {{{c, -s, 0}, {s, c, 0}, {0, 0, 1}}};
    return volume;
}

TEST(SimplifiedSurfaces, OfDifficultShapesHold) {
    for (const Shape& shape : kShapes) {
        SCOPED_TRACE(shape.name);
        const isoatlas::Volume volume = volume_of(shape);
        const Surface exact = isoatlas::extract(volume, shape.tau);
        const isoatlas::SimplifiedSurface simplified =
            isoatlas::simplify_surface(exact, volume.info.geometry, volume.info.extent, {}, {.threads = 2});
        const Surface one = isoatlas::simplify_surface(exact, volume.info.geometry, volume.info.extent, {}, {.threads = 1}).surface;
        EXPECT_TRUE(one.points == simplified.surface.points && one.triangles == simplified.surface.triangles);
        isoatlas::Mesh mesh;
        mesh.points = simplified.surface.points, mesh.triangles = simplified.surface.triangles;
        mesh.space = exact.space, mesh.unit = exact.unit;
        isoatlas::SimplifiedOptions how;
        how.max_distance = 0.5 + 1e-9, how.in_voxels = true;
        for (const isoatlas::CheckResult& check : verify_simplified(mesh, exact, volume.info, how).checks) {
            EXPECT_TRUE(check.holds) << check.name << ": " << check.detail;
        }
        std::cout << shape.name << ": " << exact.triangles.size() << " -> " << mesh.triangles.size() << " triangles\n";
    }
}

RC_GTEST_PROP(SimplifiedSurfaces, HaveTheSameContoursWithinTheDistance, ()) {
    simplified_surfaces_have_the_same_contours_within_the_distance();
}
RC_GTEST_PROP(SimplifiedSurfaces, KeepTheIdsOfTheirContours, ()) { simplified_surfaces_keep_the_ids_of_their_contours(); }
RC_GTEST_PROP(SimplifiedSurfaces, KeepCapsFlat, ()) { caps_of_simplified_surfaces_stay_flat(); }
RC_GTEST_PROP(SimplifiedSurfaces, HaveTheSameBytesForAnyThreads, ()) { simplified_surfaces_have_the_same_bytes_for_any_threads(); }

}  // namespace
}  // namespace oracle
