// verify_simplified: the exact surface of a volume holds against itself; each way to damage it is found under the name of what it breaks.
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "isoatlas/phantom.h"
#include "isoatlas/verify.h"

namespace isoatlas {
namespace {

/// Nested shells, at an isovalue that shows several contours, one inside the other.
class VerifySimplified : public testing::Test {
protected:
    Volume volume_ = make_phantom("nested-shells", {.size = 32, .shells = 2});
    Surface exact_ = extract(volume_, 0.5);

    [[nodiscard]] Mesh mesh() const {
        Mesh mesh;
        mesh.points = exact_.points;
        mesh.triangles = exact_.triangles;
        return mesh;
    }
    [[nodiscard]] SimplifiedReport report(const Mesh& mesh, const SimplifiedOptions& options = {}) const {
        return verify_simplified(mesh, exact_, volume_.info, options, {.threads = 2});
    }
    /// Names of the checks that do not hold, in order.
    [[nodiscard]] std::vector<std::string> broken(const Mesh& mesh, const SimplifiedOptions& options = {}) const {
        std::vector<std::string> names;
        for (const CheckResult& check : report(mesh, options).checks) {
            EXPECT_FALSE(check.detail.empty()) << check.name;
            if (!check.holds) names.push_back(check.name);
        }
        return names;
    }
    static bool has(const std::vector<std::string>& names, const std::string& name) { return std::ranges::count(names, name) == 1; }
};

using Names = std::vector<std::string>;

TEST_F(VerifySimplified, TheExactSurfaceHolds) {
    const SimplifiedReport found = report(mesh(), {.max_distance = 1e-3});
    EXPECT_EQ(broken(mesh(), {.max_distance = 1e-3}), Names{});
    EXPECT_GE(found.exact_contours, 2);
    EXPECT_EQ(found.contours, found.exact_contours);
    EXPECT_EQ(found.genus.value(), found.exact_genus);
    EXPECT_EQ(found.to_exact.lower, 0);
    EXPECT_LE(found.from_exact.upper, 1e-3);
}

TEST_F(VerifySimplified, AMovedPointIsMeasuredAndLimited) {
    Mesh moved = mesh();
    const Vec3 normal{exact_.normals[0][0], exact_.normals[0][1], exact_.normals[0][2]};
    for (std::size_t axis = 0; axis < 3; ++axis) moved.points[0][axis] += 0.3 * normal[axis];
    const SimplifiedReport found = report(moved);
    EXPECT_GT(found.to_exact.lower, 0.2);
    EXPECT_LE(found.to_exact.upper, 0.3 + 1e-9);
    EXPECT_LE(found.from_exact.upper, found.to_exact.upper);
    EXPECT_EQ(broken(moved, {.max_distance = 0.31}), Names{});
    EXPECT_EQ(broken(moved, {.max_distance = 0.2, .in_voxels = true}), Names{"distance_is_within"});
    EXPECT_THROW((void)report(moved, {.max_distance = 0}), Error);
}

TEST_F(VerifySimplified, AMissingContourIsFoundThoughTheRestIsClosed) {
    Mesh less = mesh();
    const std::int64_t contour = exact_.contour.back();
    std::erase_if(less.triangles, [&](const auto& triangle) { return exact_.contour[triangle[0]] == contour; });
    const Names names = broken(less, {.max_distance = 0.1});
    EXPECT_TRUE(has(names, "contours_are_one_to_one"));
    EXPECT_TRUE(has(names, "distance_is_within"));
    EXPECT_FALSE(has(names, "surface_is_closed"));
}

TEST_F(VerifySimplified, ASurfaceThatCrossesItselfIsFound) {
    Mesh pushed = mesh();
    Vec3 centre{};
    for (const Vec3& point : pushed.points)
        for (std::size_t axis = 0; axis < 3; ++axis) centre[axis] += point[axis] / static_cast<double>(pushed.points.size());
    for (std::size_t axis = 0; axis < 3; ++axis)
        pushed.points[0][axis] += 2 * (centre[axis] - pushed.points[0][axis]);  // through all shells
    EXPECT_TRUE(has(broken(pushed), "surface_does_not_cross_itself"));
}

TEST_F(VerifySimplified, AHoleIsFoundButNotOfAnOpenSurface) {
    Mesh open = mesh();
    open.triangles.pop_back();
    EXPECT_TRUE(has(broken(open), "surface_is_closed"));
    exact_.closed = false;
    const Names names = broken(open);
    EXPECT_FALSE(has(names, "surface_is_closed"));
    EXPECT_TRUE(has(names, "contours_have_same_genus"));  // a rim
}

TEST_F(VerifySimplified, PointsThatAreNoneEndIt) {
    Mesh damaged = mesh();
    damaged.points[0][1] = std::nan("");
    EXPECT_EQ(broken(damaged)[0], "points_are_finite");
    EXPECT_FALSE(report(damaged).is_measured);
    damaged = mesh();
    damaged.triangles[0][0] = 1 << 30;
    EXPECT_EQ(broken(damaged), Names{"indices_are_valid"});
}

TEST_F(VerifySimplified, SpacesAreTurnedAndUnitsCompared) {
    exact_.space = "RAS";
    Mesh turned = mesh();
    for (Vec3& point : turned.points) point[0] = -point[0], point[1] = -point[1];
    EXPECT_EQ(report(turned).to_exact.upper, report(turned).to_exact.lower);  // LPS, as meshes are written
    EXPECT_EQ(report(turned).to_exact.upper, 0);
    EXPECT_GT(report(turned, {.space = PointSpace::ras}).to_exact.lower, 1);
    turned.space = "LPS";
    EXPECT_EQ(report(turned, {.space = PointSpace::ras}).to_exact.upper, 0);
    turned.unit = "m", exact_.unit = "mm";
    EXPECT_THROW((void)report(turned), Error);
}

TEST(VerifySimplifiedVoxels, CountStepsBetweenSamples) {
    VolumeInfo info = make_phantom("nested-shells", {.size = 16, .shells = 1}).info;
    info.geometry.spacing = {1, 1, 4};
    Volume volume = make_phantom("nested-shells", {.size = 16, .shells = 1});
    const Surface unit = extract(volume, 0.5);
    Surface exact = unit;
    for (Vec3& point : exact.points) point = to_physical(info.geometry, point);
    Mesh lifted;
    lifted.points = exact.points, lifted.triangles = exact.triangles;
    for (Vec3& point : lifted.points) point[2] += 1;  // a quarter of a step
    const SimplifiedReport found = verify_simplified(lifted, exact, info);
    EXPECT_LE(found.to_exact.upper, 1.0011);
    EXPECT_GT(found.to_exact.lower, 0.9);
    EXPECT_LE(found.to_exact_in_voxels.upper, 0.2511);
    EXPECT_GT(found.to_exact_in_voxels.lower, 0.2);
}

/// Of noise, with ties, contours that touch the border, tunnels through cells: one style of surface against the other, which has further
/// points.
RC_GTEST_PROP(VerifySimplifiedNoise, StylesHaveTheSameContours, (std::uint64_t seed)) {
    const int levels = *rc::gen::element(2, 3, 5, 256);
    const Volume volume = make_phantom("noise", {.size = *rc::gen::inRange<std::int64_t>(2, 7), .seed = seed, .quantise = levels});
    const double tau = *rc::gen::inRange(0, levels) + *rc::gen::element(0.0, 0.5);
    ExtractOptions full;
    full.surface.style = SurfaceStyle::full;
    const Surface exact = extract(volume, tau, full), compact = extract(volume, tau);
    if (exact.triangles.empty()) return;
    Mesh mesh;
    mesh.points = compact.points, mesh.triangles = compact.triangles;
    for (const CheckResult& check :
         verify_simplified(mesh, exact, volume.info, {.max_distance = 2, .in_voxels = true}, {.threads = 1}).checks)
        if (!check.holds) RC_FAIL(check.name + ": " + check.detail);
}

}  // namespace
}  // namespace isoatlas
