#include "measures/surface_parts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <unordered_map>
#include <unordered_set>

#include "base/big_vector.h"
#include "base/cancel.h"
#include "base/check.h"
#include "base/parallel.h"
#include "base/streamed.h"
#include "measures/convex_hull.h"
#include "measures/feret.h"
#include "measures/vectors.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kBlock = std::int64_t{1} << 15;  // points, triangles: fixed, for the order of the sums

/// Numbers 0 .. count - 1 of things that belong to one object each, object after object.
struct Grouped {
    std::vector<std::int64_t> first;  ///< of each object, and the end
    BigVector<std::int64_t> item;

    template <class ObjectOf>
    Grouped(std::size_t objects, std::size_t count, const ObjectOf& object_of) : first(objects + 1), item(count) {
        for (const std::size_t i : streamed(count, in_order(2))) ++first[static_cast<std::size_t>(object_of(i)) + 1];
        for (std::size_t object = 0; object < objects; ++object) first[object + 1] += first[object];
        std::vector<std::int64_t> next = first;
        for (const std::size_t i : streamed(count, in_order(3))) {
            item[static_cast<std::size_t>(next[static_cast<std::size_t>(object_of(i))]++)] = static_cast<std::int64_t>(i);
        }
    }
    [[nodiscard]] std::int64_t count(std::size_t object) const { return first[object + 1] - first[object]; }
};

/// At most kBlock things of one object.
struct Part {
    std::size_t object;
    std::int64_t begin, end;  ///< of Grouped::item
};
std::vector<Part> parts_of(const Grouped& grouped) {
    std::vector<Part> parts;
    for (std::size_t object = 0; object + 1 < grouped.first.size(); ++object) {
        for (std::int64_t begin = grouped.first[object]; begin < grouped.first[object + 1]; begin += kBlock)
            parts.push_back({object, begin, std::min(begin + kBlock, grouped.first[object + 1])});
    }
    return parts;
}

/// Which of the objects each point belongs to. Also counts the contours of each object.
BigVector<std::int32_t> objects_of_points(const Surface& surface, std::span<ObjectMeasures> objects, std::vector<std::int64_t>& contours) {
    std::unordered_map<std::int64_t, std::int32_t> position;
    for (std::size_t i = 0; i < objects.size(); ++i) position.emplace(objects[i].id, static_cast<std::int32_t>(i));
    std::unordered_set<std::int64_t> seen;
    BigVector<std::int32_t> object(surface.points.size());
    std::int64_t id = -1, contour = -1;
    std::int32_t at = -1;
    for (const std::size_t i : streamed(surface.points.size(), in_order(3))) {
        if (surface.object[i] != id || surface.contour[i] != contour) {
            id = surface.object[i], contour = surface.contour[i];
            const auto found = position.find(id);
            ISOATLAS_CHECK(found != position.end());
            at = found->second;
            if (seen.insert(contour).second) ++contours[static_cast<std::size_t>(at)];
        }
        object[i] = at;
    }
    return object;
}

/// Places in which planes and volumes are measured: near the object; 2D: in the plane of the grid.
struct Frame {
    Vec3 origin{};
    Mat3 axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  ///< rows

    Frame(const Geometry& geometry, int rank) {
        if (rank == 3) return;
        const Mat3 columns = transposed(geometry.direction);
        const Vec3 x = unit(columns[0]), across = minus(columns[1], times(dot(columns[1], x), x)), y = unit(across);
        axes = {x, y, cross(x, y)};
    }
    [[nodiscard]] Vec3 local(const Vec3& point) const { return times(axes, minus(point, origin)); }
    [[nodiscard]] Vec3 direction(const Vec3& local) const { return times(transposed(axes), local); }
    [[nodiscard]] Vec3 point(const Vec3& local) const { return plus(origin, direction(local)); }
};

struct Sums {
    double area = 0, volume = 0;
};

/// The triangle, and the tetrahedron between it and the origin of the frame: divergence theorem.
Sums sums_of(const Surface& surface, const std::array<std::int64_t, 3>& triangle, const Frame& frame) {
    const auto corner = [&](std::size_t i) { return frame.local(surface.points[static_cast<std::size_t>(triangle[i])]); };
    const Vec3 a = corner(0), b = corner(1), c = corner(2);
    return {norm(cross(minus(b, a), minus(c, a))) / 2, dot(a, cross(b, c)) / 6};
}

/// The segment, and the triangle between it and the origin.
Sums sums_of(const Surface& surface, const std::array<std::int64_t, 2>& segment, const Frame& frame) {
    const auto end = [&](std::size_t i) { return frame.local(surface.points[static_cast<std::size_t>(segment[i])]); };
    const Vec3 a = end(0), b = end(1);
    return {norm(minus(b, a)), (a[0] * b[1] - a[1] * b[0]) / 2};
}

template <class Facets>
std::vector<Sums> sums_of_objects(const Surface& surface, const Facets& facets, const Grouped& grouped, const std::vector<Frame>& frames,
                                  const Context& context) {
    const std::vector<Part> parts = parts_of(grouped);
    std::vector<Sums> of_part(parts.size()), of_object(frames.size());
    const CallerLooks look(context);
    for_each_block(context.threads, std::ssize(parts), [&](std::int64_t block) {
        look();
        const Part& part = parts[static_cast<std::size_t>(block)];
        Sums sums;
        for (std::int64_t i = part.begin; i < part.end; ++i) {
            const auto facet = static_cast<std::size_t>(grouped.item[static_cast<std::size_t>(i)]);
            const Sums one = sums_of(surface, facets[facet], frames[part.object]);
            sums.area += one.area, sums.volume += one.volume;
        }
        of_part[static_cast<std::size_t>(block)] = sums;
    });
    for (std::size_t i = 0; i < parts.size(); ++i) {
        of_object[parts[i].object].area += of_part[i].area;
        of_object[parts[i].object].volume += of_part[i].volume;
    }
    return of_object;
}

/// Euler number, tunnels and cavities from the numbers of points, triangles and contours: chi of the surface is 2 for each contour less
/// twice the tunnels (docs/theory/4-genus.md#objects).
void set_topology(ObjectMeasures& object, std::int64_t contours, std::int64_t points, std::int64_t facets, int rank) {
    object.facets = facets;
    object.cavities = rank == 3 ? contours - 1 : 0;
    object.tunnels = contours - (rank == 3 ? (points - facets / 2) / 2 : 1);
    object.euler = 1 - object.tunnels + object.cavities;
}

void set_sizes(ObjectMeasures& object, const Sums& sums, int rank) {
    constexpr double pi = std::numbers::pi;
    object.area = sums.area;
    object.volume = std::abs(sums.volume);  // 2D: the plane may be mirrored
    if (rank == 3) {
        object.equivalent_diameter = std::cbrt(6 * object.volume / pi);
        object.sphericity = pi * object.equivalent_diameter * object.equivalent_diameter / object.area;
    } else {
        object.equivalent_diameter = 2 * std::sqrt(object.volume / pi);
        object.sphericity = 4 * pi * object.volume / (object.area * object.area);
    }
}

/// candidates: in the frame; holds all vertices of the hull.
void set_extent(ObjectMeasures& object, std::span<const Vec3> candidates, const Frame& frame, int rank) {
    const ConvexHull hull = convex_hull(candidates, rank);
    object.feret = feret_diameters(hull, rank);
    object.feret.max_direction = pointed(frame.direction(object.feret.max_direction));
    object.feret.min_direction = pointed(frame.direction(object.feret.min_direction));
    Vec3 middle{};
    for (std::size_t k = 0; k < static_cast<std::size_t>(rank); ++k) {
        const Vec3 axis = times(frame.axes, object.axes.direction[k]);
        double low = dot(axis, hull.vertices[0]), high = low;
        for (const Vec3& v : hull.vertices) {
            low = std::min(low, dot(axis, v));
            high = std::max(high, dot(axis, v));
        }
        object.box.size[k] = high - low;
        middle = plus(middle, times(low + (high - low) / 2, axis));
    }
    object.box.centre = frame.point(middle);
}

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr std::array<Vec3, 2> kNoBounds{{{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}}};

void widen(std::array<Vec3, 2>& bounds, const std::array<Vec3, 2>& by) {
    for (std::size_t k = 0; k < 3; ++k) {
        bounds[0][k] = std::min(bounds[0][k], by[0][k]);
        bounds[1][k] = std::max(bounds[1][k], by[1][k]);
    }
}

/// Hulls of the parts of each object, then of what they leave.
void set_extents(const Surface& surface, const Grouped& points, const std::vector<Frame>& frames, int rank,
                 std::span<ObjectMeasures> objects, const Context& context) {
    const std::vector<Part> parts = parts_of(points);
    std::vector<std::vector<Vec3>> left(parts.size());
    std::vector<std::array<Vec3, 2>> bounds(parts.size());
    const CallerLooks look(context);
    const auto local_points = [&](const Part& part, std::array<Vec3, 2>& box) {
        std::vector<Vec3> local;
        box = kNoBounds;
        local.reserve(static_cast<std::size_t>(part.end - part.begin));
        for (std::int64_t i = part.begin; i < part.end; ++i) {
            const Vec3& point = surface.points[static_cast<std::size_t>(points.item[static_cast<std::size_t>(i)])];
            widen(box, {point, point});
            local.push_back(frames[part.object].local(point));
            if (rank == 2) local.back()[2] = 0;
        }
        return local;
    };
    for_each_block(context.threads, std::ssize(parts), [&](std::int64_t block) {
        look();
        const Part& part = parts[static_cast<std::size_t>(block)];
        std::vector<Vec3> local = local_points(part, bounds[static_cast<std::size_t>(block)]);
        const bool alone = part.end - part.begin == points.count(part.object);
        if (alone) return set_extent(objects[part.object], local, frames[part.object], rank);
        left[static_cast<std::size_t>(block)] = hull_points(local, rank);
    });
    for (std::size_t first = 0, end = 0; first < parts.size(); first = end) {
        std::vector<Vec3> candidates;
        for (end = first; end < parts.size() && parts[end].object == parts[first].object; ++end)
            candidates.insert(candidates.end(), left[end].begin(), left[end].end());
        const std::size_t object = parts[first].object;
        objects[object].bounds = bounds[first];
        for (std::size_t i = first + 1; i < end; ++i) widen(objects[object].bounds, bounds[i]);
        if (!candidates.empty()) set_extent(objects[object], candidates, frames[object], rank);
    }
}

}  // namespace

void measure_surface(const Surface& surface, const VolumeInfo& info, std::span<ObjectMeasures> objects, const Context& context) {
    const int rank = info.extent.rank;
    std::vector<std::int64_t> contours(objects.size());
    const BigVector<std::int32_t> object = objects_of_points(surface, objects, contours);
    const Grouped points(objects.size(), object.size(), [&](std::size_t point) { return object[point]; });
    std::vector<Frame> frames(objects.size(), Frame(info.geometry, rank));
    for (std::size_t i = 0; i < objects.size(); ++i) {
        ISOATLAS_CHECK(points.count(i) > 0);
        frames[i].origin = surface.points[static_cast<std::size_t>(points.item[static_cast<std::size_t>(points.first[i])])];
    }
    const auto measure_facets = [&](const auto& facets) {
        const Grouped grouped(objects.size(), facets.size(), [&](std::size_t f) { return object[static_cast<std::size_t>(facets[f][0])]; });
        const std::vector<Sums> sums = sums_of_objects(surface, facets, grouped, frames, context);
        for (std::size_t i = 0; i < objects.size(); ++i) {
            set_sizes(objects[i], sums[i], rank);
            set_topology(objects[i], contours[i], points.count(i), grouped.count(i), rank);
        }
    };
    rank == 3 ? measure_facets(surface.triangles) : measure_facets(surface.segments);
    set_extents(surface, points, frames, rank, objects, context);
}

}  // namespace isoatlas
