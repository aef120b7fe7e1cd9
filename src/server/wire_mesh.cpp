#include "server/wire_mesh.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>

#include "isoatlas/error.h"
#include "server/coarse_surface.h"

namespace isoatlas::server {
namespace {

constexpr std::uint32_t kHeaderBytes = 56;
constexpr double kSteps = 65535;

struct WirePoint {
    std::array<std::uint16_t, 3> position{};
    std::array<std::int8_t, 2> normal{};
};
static_assert(sizeof(WirePoint) == 8);

struct Header {
    std::array<char, 4> magic{'i', 'a', 'm', '1'};
    std::uint32_t points = 0, triangles = 0, point_bytes = 0, triangle_bytes = 0, zero = 0;
    Vec3 origin{};
    double step = 1;
};
static_assert(sizeof(Header) == kHeaderBytes);

struct Box {
    Vec3 low, high;
};

Box box_of(const Surface& surface) {
    constexpr double far = std::numeric_limits<double>::infinity();
    Box box{{far, far, far}, {-far, -far, -far}};
    for (const Vec3& point : surface.points) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            box.low[axis] = std::min(box.low[axis], point[axis]);
            box.high[axis] = std::max(box.high[axis], point[axis]);
        }
    }
    return surface.points.empty() ? Box{{0, 0, 0}, {0, 0, 0}} : box;
}

/// The unit sphere onto a square: the octahedron |x| + |y| + |z| = 1 with its lower half folded out.
std::array<std::int8_t, 2> octahedral(const std::array<float, 3>& normal) {
    const float length = std::abs(normal[0]) + std::abs(normal[1]) + std::abs(normal[2]);
    float x = normal[0] / length, y = normal[1] / length;
    if (normal[2] < 0) {
        const float folded = (1 - std::abs(y)) * std::copysign(1.0F, x);
        y = (1 - std::abs(x)) * std::copysign(1.0F, y);
        x = folded;
    }
    return {static_cast<std::int8_t>(std::lround(127 * x)), static_cast<std::int8_t>(std::lround(127 * y))};
}

std::vector<WirePoint> quantised(const Surface& surface, const Header& header) {
    std::vector<WirePoint> points(surface.points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double steps = std::round((surface.points[i][axis] - header.origin[axis]) / header.step);
            points[i].position[axis] = static_cast<std::uint16_t>(std::clamp(steps, 0.0, kSteps));
        }
        points[i].normal = octahedral(surface.normals[i]);
    }
    return points;
}

std::vector<unsigned> corners_of(const Surface& surface) {
    std::vector<unsigned> corners;
    corners.reserve(3 * surface.triangles.size());
    for (const auto& triangle : surface.triangles) {
        for (const std::int64_t corner : triangle) corners.push_back(static_cast<unsigned>(corner));
    }
    return corners;
}

/// At most so many triangles, where clusters of points become one.
std::vector<unsigned> fewer(const std::vector<unsigned>& corners, const std::vector<WirePoint>& points, std::size_t most) {
    std::vector<float> positions;
    positions.reserve(3 * points.size());
    for (const WirePoint& point : points) positions.insert(positions.end(), point.position.begin(), point.position.end());
    return fewer_triangles(corners, positions, most);
}

/// Triangles in strips, points in the order in which they come first: neighbours have near numbers, so both pack well.
void put_in_order(std::vector<unsigned>& corners, std::vector<WirePoint>& points) {
    std::vector<unsigned> strips(corners.size());
    meshopt_optimizeVertexCacheStrip(strips.data(), corners.data(), corners.size(), points.size());
    std::vector<WirePoint> ordered(points.size());
    ordered.resize(
        meshopt_optimizeVertexFetch(ordered.data(), strips.data(), strips.size(), points.data(), points.size(), sizeof(WirePoint)));
    corners.swap(strips);
    points.swap(ordered);
}

std::span<unsigned char> room(std::vector<std::byte>& bytes, std::size_t more) {
    const std::size_t before = bytes.size();
    bytes.resize(before + more);
    return {reinterpret_cast<unsigned char*>(bytes.data()) + before, more};
}

void check(const Surface& surface) {
    if (surface.points.size() < (std::size_t{1} << 31) && surface.triangles.size() < (std::size_t{1} << 30)) return;
    throw Error(ErrorKind::resource, {.what = "the surface has too many triangles for a viewer",
                                      .expected = "fewer than 2^30",
                                      .next = "ask for one object, or for another isovalue"});
}

}  // namespace

WireMesh wire_mesh(const Surface& surface, const WireOptions& options) {
    check(surface);
    const Box box = box_of(surface);
    Header header;
    header.origin = box.low;
    header.step = options.step;
    for (std::size_t axis = 0; axis < 3; ++axis) header.step = std::max(header.step, (box.high[axis] - box.low[axis]) / kSteps);
    std::vector<WirePoint> points = quantised(surface, header);
    std::vector<unsigned> corners = corners_of(surface);
    WireMesh mesh;
    mesh.coarse = options.most_triangles > 0 && surface.triangles.size() > static_cast<std::size_t>(options.most_triangles);
    if (mesh.coarse) corners = fewer(corners, points, static_cast<std::size_t>(options.most_triangles));
    put_in_order(corners, points);
    mesh.points = static_cast<std::int64_t>(points.size());
    mesh.triangles = static_cast<std::int64_t>(corners.size() / 3);
    mesh.bytes.resize(kHeaderBytes);
    const auto pack = [&mesh](std::size_t bound, auto&& encode) {
        const std::size_t before = mesh.bytes.size();
        const std::span<unsigned char> to = room(mesh.bytes, bound);
        const std::size_t bytes = encode(to.data(), to.size());
        mesh.bytes.resize(before + bytes);
        return static_cast<std::uint32_t>(bytes);
    };
    meshopt_encodeVertexVersion(0);
    meshopt_encodeIndexVersion(1);
    header.points = static_cast<std::uint32_t>(points.size());
    header.triangles = static_cast<std::uint32_t>(mesh.triangles);
    header.point_bytes = pack(meshopt_encodeVertexBufferBound(points.size(), sizeof(WirePoint)), [&](unsigned char* to, std::size_t size) {
        return meshopt_encodeVertexBuffer(to, size, points.data(), points.size(), sizeof(WirePoint));
    });
    header.triangle_bytes = pack(meshopt_encodeIndexBufferBound(corners.size(), points.size()), [&](unsigned char* to, std::size_t size) {
        return meshopt_encodeIndexBuffer(to, size, corners.data(), corners.size());
    });
    std::memcpy(mesh.bytes.data(), &header, sizeof header);
    return mesh;
}

}  // namespace isoatlas::server
