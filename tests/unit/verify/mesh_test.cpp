// verify_mesh: a tetrahedron holds; each way to damage it is found under the name of the guarantee it breaks.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "isoatlas/verify.h"

namespace isoatlas {
namespace {

Mesh tetrahedron() {
    Mesh mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    return mesh;
}

/// Names of the checks that do not hold, in order.
std::vector<std::string> broken(const Mesh& mesh) {
    std::vector<std::string> names;
    for (const CheckResult& check : verify_mesh(mesh)) {
        EXPECT_FALSE(check.detail.empty()) << check.name;
        if (!check.holds) names.push_back(check.name);
    }
    return names;
}

using Names = std::vector<std::string>;

TEST(VerifyMesh, ATetrahedronHolds) {
    EXPECT_EQ(broken(tetrahedron()), Names{});
    EXPECT_EQ(verify_mesh(tetrahedron()).back().detail, "1 components, genus 0 in all");
}

TEST(VerifyMesh, AMissingTriangleIsAHole) {
    Mesh mesh = tetrahedron();
    mesh.triangles.pop_back();
    const Names names = broken(mesh);
    EXPECT_EQ(std::count(names.begin(), names.end(), "surface_is_closed"), 1);
    EXPECT_EQ(std::count(names.begin(), names.end(), "euler_numbers_are_even"), 1);
}

TEST(VerifyMesh, ATurnedTriangleIsMisoriented) {
    Mesh mesh = tetrahedron();
    std::swap(mesh.triangles[0][0], mesh.triangles[0][1]);
    EXPECT_EQ(broken(mesh), Names{"surface_is_oriented"});
}

TEST(VerifyMesh, TwoSolidsThatShareAPointAreNoManifold) {
    Mesh mesh = tetrahedron();
    mesh.points.insert(mesh.points.end(), {{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}});
    for (std::size_t i = 0; i < 4; ++i) {
        auto other = mesh.triangles[i];
        for (std::int64_t& point : other) point = point == 0 ? 0 : point + 3;
        std::swap(other[0], other[1]);  // a point reflection turns the inside out
        mesh.triangles.push_back(other);
    }
    const Names names = broken(mesh);
    EXPECT_EQ(std::count(names.begin(), names.end(), "surface_is_manifold"), 1);
    EXPECT_EQ(std::count(names.begin(), names.end(), "surface_is_closed"), 0);
}

TEST(VerifyMesh, AFlatTriangleHasNoArea) {
    Mesh mesh = tetrahedron();
    mesh.points[3] = {2, 0, 0};  // triangle 0 1 3 is a segment now
    EXPECT_EQ(broken(mesh), Names{"surface_has_no_zero_area"});
}

TEST(VerifyMesh, ImpossibleIndicesAreReportedAndNotFollowed) {
    Mesh mesh = tetrahedron();
    mesh.triangles[2][1] = 4;
    EXPECT_EQ(broken(mesh), Names{"indices_are_valid"});
    mesh.triangles[2][1] = -1;
    EXPECT_EQ(broken(mesh), Names{"indices_are_valid"});
}

TEST(VerifyMesh, PointsAreNumbers) {
    Mesh mesh = tetrahedron();
    mesh.points[1][2] = std::numeric_limits<double>::quiet_NaN();
    const Names names = broken(mesh);
    EXPECT_EQ(std::count(names.begin(), names.end(), "points_are_finite"), 1);
}

TEST(VerifyMesh, NothingIsNoSurface) { EXPECT_EQ(broken(Mesh{}), Names{"surface_exists"}); }

}  // namespace
}  // namespace isoatlas
