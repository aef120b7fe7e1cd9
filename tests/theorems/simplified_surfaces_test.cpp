// A simplified surface is the exact one with fewer triangles: the same contours, embedded, within the distance, in both directions.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <iostream>

#include "oracle/coarse_surfaces.h"

namespace oracle {
namespace {

void simplified_surfaces_have_the_same_contours_within_the_distance() {
    const CoarseCase c;
    const isoatlas::SimplifiedSurface simplified = c.simplified(arbitrary_context());
    const Surface& surface = simplified.surface;
    RC_ASSERT(surface.triangles.size() <= c.exact.triangles.size());
    RC_ASSERT(surface.normals.size() == surface.points.size());
    RC_ASSERT(surface.object.size() == surface.points.size());
    RC_ASSERT(surface.contour.size() == surface.points.size());
    if (surface.points.empty()) return;
    const std::string failure = coarse_failure(surface, c.exact, c.volume.info, {simplified.distance, c.options.unit});
    if (!failure.empty()) RC_FAIL(failure);
}

void simplified_surfaces_keep_the_ids_of_their_contours() {
    const CoarseCase c;
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
    CoarseCase c;
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
    const CoarseCase c;
    const Surface one = c.simplified({.threads = 1}).surface, two = c.simplified({.threads = 2}).surface;
    RC_ASSERT(one.points == two.points);
    RC_ASSERT(one.triangles == two.triangles);
    RC_ASSERT(one.normals == two.normals);
    RC_ASSERT(one.contour == two.contour);
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
        EXPECT_EQ(coarse_failure(simplified.surface, exact, volume.info, {0.5}), "");
        std::cout << shape.name << ": " << exact.triangles.size() << " -> " << simplified.surface.triangles.size() << " triangles\n";
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
