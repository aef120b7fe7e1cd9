// Points in place of a surface that has too many triangles: they are points of the exact surface on edges of the grid, spread over its
// area.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "geometry/vectors.h"
#include "isoatlas/error.h"
#include "isoatlas/octree_front.h"
#include "oracle/coarse_surfaces.h"

namespace oracle {
namespace {

using isoatlas::FrontOptions;
using isoatlas::FrontSurface;
using isoatlas::Vec3;
using Normal = std::array<float, 3>;

double area_of(const Surface& surface) {
    double area = 0;
    for (const auto& [a, b, c] : surface.triangles) {
        const Vec3 &first = surface.points[a], u = isoatlas::minus(surface.points[b], first), v = isoatlas::minus(surface.points[c], first);
        area += isoatlas::norm(isoatlas::cross(u, v)) / 2;
    }
    return area;
}

void points_are_some_of_the_exact_surface() {
    CoarseCase c;
    RC_PRE(c.exact.closed && !c.exact.triangles.empty());
    c.volume.info.geometry = {};
    isoatlas::ExtractOptions how{.interpolant = c.exact.interpolant};
    how.surface.ids = *rc::gen::arbitrary<bool>();
    const auto all = std::ssize(isoatlas::extract(c.volume, c.exact.tau, how).triangles);
    if (*rc::gen::arbitrary<bool>()) how.surface.objects = {*rc::gen::elementOf(c.exact.object)};
    const Surface exact = isoatlas::extract(c.volume, c.exact.tau, how);
    std::set<std::pair<Vec3, Normal>> hits;
    double area = 0;
    for (std::size_t i = 0; i < exact.points.size(); ++i) {
        if (!is_hit(exact.points[i])) continue;
        hits.insert({exact.points[i], exact.normals[i]});
        const auto& [x, y, z] = exact.normals[i];
        area += 1 / (static_cast<double>(std::abs(x)) + static_cast<double>(std::abs(y)) + static_cast<double>(std::abs(z)));
    }
    FrontOptions options{.max_level = *rc::gen::inRange(0, 5)};
    options.exact_above = *rc::gen::element<std::int64_t>(0, 1, 2 * std::ssize(hits) - 1, 2 * std::ssize(hits), all);
    const FrontSurface without = extract_front(c.volume, c.exact.tau, options, how);
    options.points = *rc::gen::element(1, 2, 7, 50, 3000);
    const FrontSurface front = extract_front(c.volume, c.exact.tau, options, how, arbitrary_context());

    const bool are_points = options.exact_above > 0 && all > options.exact_above && 2 * std::ssize(hits) > options.exact_above;
    RC_ASSERT((front.spacing > 0) == are_points);
    if (!are_points) {
        RC_ASSERT(front.leaves == without.leaves || without.leaves.empty());  // a few more triangles may be twice the hits
        return;
    }
    RC_ASSERT(front.leaves.empty() && front.surface.triangles.empty());
    RC_ASSERT(front.surface.object.empty() && front.surface.contour.empty());
    RC_ASSERT(std::abs(std::ssize(front.surface.points) - options.points) <= 1);
    RC_ASSERT(front.surface.normals.size() == front.surface.points.size());
    for (std::size_t i = 0; i < front.surface.points.size(); ++i)
        RC_ASSERT(hits.contains({front.surface.points[i], front.surface.normals[i]}));
    const double covered = front.spacing * front.spacing * static_cast<double>(options.points);
    RC_ASSERT(std::abs(covered - area) <= 1e-5 * area);
    if (options.points < std::ssize(hits) / 4) {  // none stands for two parts: a hit has at most sqrt(3) times the area of another
        RC_ASSERT(std::set<Vec3>(front.surface.points.begin(), front.surface.points.end()).size() == front.surface.points.size());
    }
}

/// On oblique axes of different steps: as many points in a half as it has area, and the area is that of the triangles.
TEST(FrontPoints, CoverSmoothSurfacesEvenly) {
    const auto shape = [](double x, double y, double z) {
        const double u = (x - 30) / 24, v = (y - 20) / 15, w = (z - 14) / 9;
        return 1 - std::sqrt(u * u + v * v + w * w);
    };
    isoatlas::Volume volume = volume_of({"an ellipsoid", {3, {60, 40, 30}}, shape, 0});
    volume.info.geometry.direction[0][2] = 0.3;
    const Surface exact = isoatlas::extract(volume, 0);
    const FrontSurface front = extract_front(volume, 0, {.exact_above = 1, .points = 2000});
    ASSERT_NEAR(static_cast<double>(front.surface.points.size()), 2000, 1);
    EXPECT_NEAR(front.spacing * front.spacing * 2000, area_of(exact), 0.01 * area_of(exact));
    const Vec3 centre = to_physical(volume.info.geometry, {30, 20, 14});
    for (const Vec3& direction : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{0.6, 0, 0.8}}) {
        const auto beyond = [&](const Vec3& p) { return isoatlas::dot(isoatlas::minus(p, centre), direction) > 4; };
        Surface part = exact;
        const auto is_beyond = [&](const auto& t) { return beyond(exact.points[t[0]]); };
        part.triangles.clear();
        for (const auto& t : exact.triangles) {
            if (is_beyond(t)) part.triangles.push_back(t);
        }
        const double share = area_of(part) / area_of(exact);
        EXPECT_NEAR(static_cast<double>(std::ranges::count_if(front.surface.points, beyond)) / 2000, share, 0.02);
    }
}

TEST(FrontPoints, NeedNormalsAndANumber) {
    const isoatlas::Volume volume = volume_of(kShapes[5]);
    isoatlas::ExtractOptions without;
    without.surface.normals = false;
    EXPECT_THROW((void)extract_front(volume, 0.3, {.exact_above = 1, .points = 9}, without), isoatlas::Error);
    EXPECT_THROW((void)extract_front(volume, 0.3, {.exact_above = 1, .points = -1}), isoatlas::Error);
}

RC_GTEST_PROP(FrontPoints, AreSomeOfTheExactSurface, ()) { points_are_some_of_the_exact_surface(); }

}  // namespace
}  // namespace oracle
