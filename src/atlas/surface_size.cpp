#include "atlas/surface_size.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/parallel.h"
#include "geometry/vectors.h"
#include "isoatlas/surface.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kBlock = std::int64_t{1} << 14;  // facets: fixed, for the order of the sums

/// The triangle, and the tetrahedron between it and the centre.
SurfaceSize size_of(const Surface& surface, const std::array<std::int64_t, 3>& triangle, const Vec3& centre) {
    const auto corner = [&](std::size_t i) { return minus(surface.points[static_cast<std::size_t>(triangle[i])], centre); };
    const Vec3 a = corner(0), b = corner(1), c = corner(2), normal = cross(minus(b, a), minus(c, a));
    return {std::sqrt(dot(normal, normal)) / 2, dot(a, cross(b, c)) / 6};
}

/// The segment, and the triangle between it and the centre. The High side is on the left.
SurfaceSize size_of(const Surface& surface, const std::array<std::int64_t, 2>& segment, const Vec3& centre) {
    const auto end = [&](std::size_t i) { return minus(surface.points[static_cast<std::size_t>(segment[i])], centre); };
    const Vec3 a = end(0), b = end(1), along = minus(b, a), around = cross(a, b);
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

}  // namespace isoatlas
