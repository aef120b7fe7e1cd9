#include "atlas/surface_size.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/parallel.h"
#include "isoatlas/surface.h"

namespace isoatlas {
namespace {

using Point = std::array<double, 3>;

constexpr std::int64_t kBlock = std::int64_t{1} << 14;  // facets: fixed, for the order of the sums

Point minus(const Point& p, const Point& q) { return {p[0] - q[0], p[1] - q[1], p[2] - q[2]}; }
Point cross(const Point& p, const Point& q) { return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]}; }
double dot(const Point& p, const Point& q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; }

/// The triangle, and the tetrahedron between it and the centre.
SurfaceSize size_of(const Surface& surface, const std::array<std::int64_t, 3>& triangle, const Point& centre) {
    const auto corner = [&](std::size_t i) { return minus(surface.points[static_cast<std::size_t>(triangle[i])], centre); };
    const Point a = corner(0), b = corner(1), c = corner(2), normal = cross(minus(b, a), minus(c, a));
    return {std::sqrt(dot(normal, normal)) / 2, dot(a, cross(b, c)) / 6};
}

/// The segment, and the triangle between it and the centre. The High side is on the left.
SurfaceSize size_of(const Surface& surface, const std::array<std::int64_t, 2>& segment, const Point& centre) {
    const auto end = [&](std::size_t i) { return minus(surface.points[static_cast<std::size_t>(segment[i])], centre); };
    const Point a = end(0), b = end(1), along = minus(b, a), around = cross(a, b);
    return {std::sqrt(dot(along, along)), around[2] / 2};
}

template <class Facets>
SurfaceSize sum_of(const Surface& surface, const Facets& facets, const Context& context) {
    const auto count = static_cast<std::int64_t>(facets.size());
    std::vector<SurfaceSize> parts(static_cast<std::size_t>((count + kBlock - 1) / kBlock));
    for_each_block(context.threads, static_cast<std::int64_t>(parts.size()), [&](std::int64_t block) {
        SurfaceSize sum;
        for (std::int64_t i = block * kBlock; i < std::min(count, (block + 1) * kBlock); ++i) {
            const SurfaceSize one = size_of(surface, facets[static_cast<std::size_t>(i)], surface.points[0]);
            sum.area += one.area, sum.measure += one.measure;
        }
        parts[static_cast<std::size_t>(block)] = sum;
    });
    SurfaceSize size;
    for (const SurfaceSize& part : parts) size.area += part.area, size.measure += part.measure;
    return size;
}

}  // namespace

SurfaceSize size_of_surface(const Surface& surface, const Context& context) {
    SurfaceSize size = surface.segments.empty() ? sum_of(surface, surface.triangles, context) : sum_of(surface, surface.segments, context);
    size.measure = std::abs(size.measure);  // 2D in a mirrored plane
    return size;
}

std::vector<ObjectSize> sizes_of_objects(const Surface& surface) {
    std::vector<std::int64_t> ids(surface.object.begin(), surface.object.end());
    std::ranges::sort(ids);
    ids.erase(std::ranges::unique(ids).begin(), ids.end());
    const auto place = [&](std::size_t point) {
        return static_cast<std::size_t>(std::ranges::lower_bound(ids, surface.object[point]) - ids.begin());
    };
    std::vector<ObjectSize> sizes(ids.size());
    std::vector<const Point*> first(ids.size());  // centre near the object, for a precise volume
    for (std::size_t i = 0; i < surface.points.size(); ++i) {
        const Point& point = surface.points[i];
        ObjectSize& size = sizes[place(i)];
        const bool is_first = first[place(i)] == nullptr;
        if (is_first) first[place(i)] = &point, size.object = surface.object[i], size.low = size.high = point;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            size.low[axis] = std::min(size.low[axis], point[axis]);
            size.high[axis] = std::max(size.high[axis], point[axis]);
        }
    }
    for (const std::array<std::int64_t, 3>& triangle : surface.triangles) {
        const std::size_t object = place(static_cast<std::size_t>(triangle[0]));
        const SurfaceSize one = size_of(surface, triangle, *first[object]);
        sizes[object].area += one.area, sizes[object].measure += one.measure, ++sizes[object].triangles;
    }
    return sizes;
}

}  // namespace isoatlas
