// What the viewer decodes is the surface, up to half a step of a position and two degrees of a normal.
#include "preview/wire_mesh.h"

#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

#include "geometry/vectors.h"
#include "isoatlas/phantom.h"
#include "preview/sample_surface.h"

namespace isoatlas {
namespace {

struct Decoded {
    std::array<std::uint32_t, 4> count{};  // points, triangles, their bytes
    Vec3 origin{};
    double step = 0;
    std::vector<Vec3> points, normals;
    std::vector<std::array<unsigned, 3>> triangles;
};

Vec3 unfolded(int a, int b) {
    double x = a / 127.0, y = b / 127.0;
    const double z = 1 - std::abs(x) - std::abs(y);
    if (z < 0) {
        const double before = x;
        x = (1 - std::abs(y)) * (x < 0 ? -1 : 1);
        y = (1 - std::abs(before)) * (y < 0 ? -1 : 1);
    }
    const double length = std::hypot(x, y, z);
    return {x / length, y / length, z / length};
}

Decoded decoded(const WireMesh& mesh) {
    Decoded result;
    const auto* bytes = reinterpret_cast<const unsigned char*>(mesh.bytes.data());
    EXPECT_EQ(std::memcmp(bytes, "iam1", 4), 0);
    std::memcpy(result.count.data(), bytes + 4, 16);
    std::memcpy(result.origin.data(), bytes + 24, 24);
    std::memcpy(&result.step, bytes + 48, 8);
    const auto [points, triangles, point_bytes, triangle_bytes] = result.count;
    EXPECT_EQ(mesh.bytes.size(), 56U + point_bytes + triangle_bytes);
    std::vector<unsigned char> records(std::size_t{8} * points);
    EXPECT_EQ(meshopt_decodeVertexBuffer(records.data(), points, 8, bytes + 56, point_bytes), 0);
    result.triangles.resize(triangles);
    EXPECT_EQ(meshopt_decodeIndexBuffer(result.triangles.data(), std::size_t{3} * triangles, 4, bytes + 56 + point_bytes, triangle_bytes),
              0);
    for (std::size_t i = 0; i < points; ++i) {
        std::array<std::uint16_t, 3> steps{};
        std::memcpy(steps.data(), records.data() + 8 * i, 6);
        Vec3 point;
        for (std::size_t axis = 0; axis < 3; ++axis) point[axis] = result.origin[axis] + result.step * steps[axis];
        result.points.push_back(point);
        result.normals.push_back(unfolded(static_cast<std::int8_t>(records[8 * i + 6]), static_cast<std::int8_t>(records[8 * i + 7])));
    }
    return result;
}

Surface surface_of(const char* phantom, double tau, std::int64_t size = 48) {
    return extract(make_phantom(phantom, {.size = size}), tau, {.surface = {.objects = {}, .contours = {}, .ids = false}});
}

/// The triangle whose corners lie nearest, as a corner cycle from the smallest number on.
std::array<unsigned, 3> cycle(std::array<unsigned, 3> triangle) {
    std::rotate(triangle.begin(), std::ranges::min_element(triangle), triangle.end());
    return triangle;
}

TEST(WireMesh, IsTheSurface) {
    bool with_strips = false;
    for (const char* phantom : {"torus-chain", "torus-chain", "demo", "noise"}) {
        const Surface surface = surface_of(phantom, 0.5);
        with_strips = !with_strips;
        ASSERT_GT(surface.points.size(), 0U) << phantom;
        constexpr double step = 1.0 / 256;
        const WireMesh mesh = wire_mesh(surface, {.step = step, .strips = with_strips});
        const Decoded result = decoded(mesh);
        EXPECT_FALSE(mesh.coarse);
        EXPECT_EQ(result.step, step);
        ASSERT_EQ(result.points.size(), surface.points.size());
        ASSERT_EQ(result.triangles.size(), surface.triangles.size());
        // Points have other numbers: each is found by its steps, which differ for all points of these surfaces.
        const auto steps = [&](const Vec3& p) {
            return std::array{std::lround((p[0] - result.origin[0]) / step), std::lround((p[1] - result.origin[1]) / step),
                              std::lround((p[2] - result.origin[2]) / step)};
        };
        std::map<std::array<long, 3>, std::vector<unsigned>> number;
        for (unsigned i = 0; i < result.points.size(); ++i) number[steps(result.points[i])].push_back(i);
        std::vector<unsigned> of(surface.points.size());
        std::size_t shared = 0;
        for (std::size_t i = 0; i < of.size(); ++i) {
            const std::vector<unsigned>& there = number[steps(surface.points[i])];
            ASSERT_FALSE(there.empty()) << phantom << ": a point has moved by more than half a step";
            shared += there.size() > 1;
            of[i] = there.front();
            if (there.size() > 1) continue;
            double cosine = 0;
            for (std::size_t axis = 0; axis < 3; ++axis)
                cosine += static_cast<double>(surface.normals[i][axis]) * result.normals[there.front()][axis];
            EXPECT_GT(cosine, std::cos(2 * 3.14159265 / 180)) << phantom << " point " << i;
        }
        if (shared > 0) continue;
        std::vector<std::array<unsigned, 3>> expected, got;
        for (const auto& t : surface.triangles) expected.push_back(cycle({of[t[0]], of[t[1]], of[t[2]]}));
        for (const auto& t : result.triangles) got.push_back(cycle(t));
        std::ranges::sort(expected);
        std::ranges::sort(got);
        EXPECT_EQ(expected, got) << phantom;
    }
}

TEST(WireMesh, OfNothing) {
    const WireMesh mesh = wire_mesh(surface_of("torus-chain", 1e9), {.step = 0.1});
    EXPECT_EQ(decoded(mesh).points.size(), 0U);
    EXPECT_EQ(mesh.triangles, 0);
}

TEST(WireMesh, StepsGrowWhereTheyWouldNotReach) {
    const Surface surface = surface_of("gyroid", 0);
    const Decoded result = decoded(wire_mesh(surface, {.step = 1e-9}));
    EXPECT_GT(result.step, 1e-9);
    for (const Vec3& point : result.points) EXPECT_LE(point[0], 48.0);
}

TEST(WireMesh, PointsAloneHaveNoTriangles) {
    const PointCloud cloud = sample_surface(surface_of("torus-chain", 0.5), 500).cloud;
    const WireMesh mesh = wire_points(cloud, 0.01);
    EXPECT_EQ(mesh.points, std::ssize(cloud.points));
    EXPECT_EQ(mesh.triangles, 0);
    const Decoded result = decoded(mesh);
    ASSERT_EQ(result.points.size(), cloud.points.size());
    std::vector<bool> taken(cloud.points.size());
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {  // in another order
        const auto near =
            std::ranges::min_element(cloud.points, {}, [&](const Vec3& point) { return norm(minus(result.points[i], point)); });
        const auto at = static_cast<std::size_t>(near - cloud.points.begin());
        EXPECT_LT(norm(minus(result.points[i], *near)), 0.01);
        EXPECT_FALSE(taken[at]);
        taken[at] = true;
        for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(result.normals[i][axis], cloud.normals[at][axis], 0.02);
    }
    EXPECT_EQ(decoded(wire_points({}, 0.01)).points.size(), 0U);
}

TEST(WireMesh, SameBytesForAnyThreads) {
    const Surface surface = surface_of("noise", 0.5);
    ASSERT_GT(surface.triangles.size(), 100000U);  // several parts
    const auto bytes_with = [&](int threads) {
        Context context;
        context.threads = threads;
        return wire_mesh(surface, {.step = 0.01}, context).bytes;
    };
    for (const int threads : {0, 2, 3}) EXPECT_EQ(bytes_with(threads), bytes_with(1));
}

}  // namespace
}  // namespace isoatlas
