#include "preview/wire_mesh.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <span>

#include "base/cancel.h"
#include "base/parallel.h"
#include "isoatlas/error.h"
#include "preview/distinct_places.h"

namespace isoatlas {
namespace {

constexpr std::uint32_t kHeaderBytes = 56;
constexpr double kSteps = 65535;
constexpr std::size_t kPart = std::size_t{3} << 15;  ///< corners: fixed, so that the bytes do not depend on threads

struct WirePoint {
    LatticePlace position{};
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

Box box_of(std::span<const Vec3> points) {
    constexpr double far = std::numeric_limits<double>::infinity();
    Box box{{far, far, far}, {-far, -far, -far}};
    for (const Vec3& point : points) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            box.low[axis] = std::min(box.low[axis], point[axis]);
            box.high[axis] = std::max(box.high[axis], point[axis]);
        }
    }
    return points.empty() ? Box{{0, 0, 0}, {0, 0, 0}} : box;
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

Header header_of(std::span<const Vec3> points, double step) {
    const Box box = box_of(points);
    Header header;
    header.origin = box.low;
    header.step = step;
    for (std::size_t axis = 0; axis < 3; ++axis) header.step = std::max(header.step, (box.high[axis] - box.low[axis]) / kSteps);
    return header;
}

std::vector<WirePoint> quantised(std::span<const Vec3> places, std::span<const std::array<float, 3>> normals, const Header& header,
                                 int threads) {
    std::vector<WirePoint> points(places.size());
    for_each_index(threads, points.size(), [&](std::size_t i) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double steps = std::round((places[i][axis] - header.origin[axis]) / header.step);
            points[i].position[axis] = static_cast<std::uint16_t>(std::clamp(steps, 0.0, kSteps));
        }
        points[i].normal = octahedral(normals[i]);
    });
    return points;
}

std::vector<unsigned> corners_of(const Surface& surface, int threads) {
    std::vector<unsigned> corners(3 * surface.triangles.size());
    for_each_index(threads, surface.triangles.size(), [&](std::size_t i) {
        for (std::size_t k = 0; k < 3; ++k) corners[3 * i + k] = static_cast<unsigned>(surface.triangles[i][k]);
    });
    return corners;
}

/// A part of the triangles in strips. Their points have close indices: memory is allocated for those only.
void put_in_strips(std::span<unsigned> corners) {
    const auto [min, max] = std::ranges::minmax(corners);
    std::vector<unsigned> near(corners.size());
    std::ranges::transform(corners, near.begin(), [first = min](unsigned corner) { return corner - first; });
    std::vector<unsigned> strips(corners.size());
    meshopt_optimizeVertexCacheStrip(strips.data(), near.data(), near.size(), std::size_t{max} - min + 1);
    std::ranges::transform(strips, corners.begin(), [first = min](unsigned corner) { return corner + first; });
}

void put_all_in_strips(std::vector<unsigned>& corners, const Context& context) {
    const std::size_t parts = (corners.size() + kPart - 1) / kPart;
    const CallerLooks look(context);
    for_each_block(context.threads, static_cast<std::int64_t>(parts), [&](std::int64_t part) {
        look();
        const std::size_t first = static_cast<std::size_t>(part) * kPart;
        put_in_strips(std::span(corners).subspan(first, std::min(kPart, corners.size() - first)));
    });
    stop_if_cancelled(context);
}

/// Points in order of first use: neighbours have close indices, so that they compress well, and triangles too.
void put_in_order(std::vector<unsigned>& corners, std::vector<WirePoint>& points) {
    std::vector<WirePoint> ordered(points.size());
    ordered.resize(
        meshopt_optimizeVertexFetch(ordered.data(), corners.data(), corners.size(), points.data(), points.size(), sizeof(WirePoint)));
    points.swap(ordered);
}

/// Points near each other one after another: they compress well.
void put_in_spatial_order(std::vector<WirePoint>& points) {
    std::vector<float> positions;
    positions.reserve(3 * points.size());
    for (const WirePoint& point : points) positions.insert(positions.end(), point.position.begin(), point.position.end());
    std::vector<unsigned> places(points.size());
    meshopt_spatialSortRemap(places.data(), positions.data(), points.size(), 3 * sizeof(float));
    std::vector<WirePoint> ordered(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) ordered[places[i]] = points[i];
    points.swap(ordered);
}

/// Returns how many triangles have no area.
std::size_t part(std::vector<WirePoint>& points, const std::vector<unsigned>& corners) {
    std::vector<LatticePlace> places(points.size());
    std::ranges::transform(points, places.begin(), &WirePoint::position);
    const std::size_t left = make_places_distinct(places, corners);
    for (std::size_t i = 0; i < points.size(); ++i) points[i].position = places[i];
    return left;
}

using Bytes = std::vector<unsigned char>;

Bytes packed(const std::vector<WirePoint>& points) {
    Bytes bytes(meshopt_encodeVertexBufferBound(points.size(), sizeof(WirePoint)));
    bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), points.data(), points.size(), sizeof(WirePoint)));
    return bytes;
}

Bytes packed(const std::vector<unsigned>& corners, std::size_t points) {
    Bytes bytes(meshopt_encodeIndexBufferBound(corners.size(), points));
    bytes.resize(meshopt_encodeIndexBuffer(bytes.data(), bytes.size(), corners.data(), corners.size()));
    return bytes;
}

/// The library stores them in globals: set once, before any thread encodes.
void choose_versions() {
    static const bool chosen = [] {
        meshopt_encodeVertexVersion(0);
        meshopt_encodeIndexVersion(1);
        return true;
    }();
    (void)chosen;
}

void check(std::size_t points, std::size_t triangles) {
    if (points < (std::size_t{1} << 31) && triangles < (std::size_t{1} << 30)) return;
    throw Error(ErrorKind::resource, {.what = "the surface has too many triangles for a viewer",
                                      .expected = "fewer than 2^30",
                                      .next = "request one object, or another isovalue"});
}

void write(Header& header, const std::vector<WirePoint>& points, const std::vector<unsigned>& corners, const Context& context,
           WireMesh& mesh) {
    choose_versions();
    mesh.points = static_cast<std::int64_t>(points.size());
    mesh.triangles = static_cast<std::int64_t>(corners.size() / 3);
    Bytes point_bytes, triangle_bytes;
    run_both(context.threads, [&] { point_bytes = packed(points); }, [&] { triangle_bytes = packed(corners, points.size()); });
    header.points = static_cast<std::uint32_t>(points.size());
    header.triangles = static_cast<std::uint32_t>(mesh.triangles);
    header.point_bytes = static_cast<std::uint32_t>(point_bytes.size());
    header.triangle_bytes = static_cast<std::uint32_t>(triangle_bytes.size());
    mesh.bytes.reserve(kHeaderBytes + point_bytes.size() + triangle_bytes.size());
    mesh.bytes.append(reinterpret_cast<const char*>(&header), sizeof header);
    for (const Bytes& bytes : {std::cref(point_bytes), std::cref(triangle_bytes)})
        mesh.bytes.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

}  // namespace

WireMesh wire_mesh(const Surface& surface, const WireOptions& options, const Context& context) {
    check(surface.points.size(), surface.triangles.size());
    Header header = header_of(surface.points, options.step);
    std::vector<WirePoint> points = quantised(surface.points, surface.normals, header, context.threads);
    std::vector<unsigned> corners = corners_of(surface, context.threads);
    WireMesh mesh;
    stop_if_cancelled(context);
    if (options.strips) put_all_in_strips(corners, context);
    put_in_order(corners, points);
    if (options.distinct) mesh.without_area = part(points, corners);
    stop_if_cancelled(context);
    write(header, points, corners, context, mesh);
    return mesh;
}

WireMesh wire_points(const PointCloud& cloud, double step, const Context& context) {
    check(cloud.points.size(), 0);
    Header header = header_of(cloud.points, step);
    std::vector<WirePoint> points = quantised(cloud.points, cloud.normals, header, context.threads);
    put_in_spatial_order(points);
    WireMesh mesh;
    write(header, points, {}, context, mesh);
    return mesh;
}

}  // namespace isoatlas
