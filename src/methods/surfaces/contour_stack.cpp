#include "methods/surfaces/contour_stack.h"

#include <algorithm>
#include <array>

#include "base/cancel.h"
#include "methods/surfaces/tiling.h"

namespace isoatlas {
namespace {

/// A closed polygon with the High side on its left.
struct Contour {
    std::vector<Vec3> corners;         ///< voxel positions
    std::vector<std::int64_t> points;  ///< of the surface
    std::array<double, 2> low, high;   ///< bounding box in x and y
    bool is_hole;                      ///< turns clockwise
};

double turning(const std::vector<Vec3>& corners) {
    double sum = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3 &p = corners[i], &q = corners[(i + 1) % corners.size()];
        sum += p[0] * q[1] - p[1] * q[0];
    }
    return sum;
}

Contour contour_of(std::vector<Vec3> corners) {
    Contour contour{std::move(corners), {}, {}, {}, false};
    contour.is_hole = turning(contour.corners) < 0;
    for (std::size_t axis = 0; axis < 2; ++axis) {
        const auto [low, high] = std::ranges::minmax(contour.corners, {}, [axis](const Vec3& p) { return p[axis]; });
        contour.low[axis] = low[axis], contour.high[axis] = high[axis];
    }
    return contour;
}

/// Of slice z; samples outside of it are Low, so that all are closed.
std::vector<Contour> contours_of(const Volume& volume, std::int64_t z, double tau, const Context& context, ExtractionCost& cost) {
    const Extent& extent = volume.info.extent;
    const Surface curves = visit_samples(volume, [&]<class T>(std::span<const T> samples) {
        const auto slice = samples.subspan(static_cast<std::size_t>(z * extent.slice()), static_cast<std::size_t>(extent.slice()));
        ExtractOptions options;
        options.surface.normals = options.surface.ids = false;
        return extract(make_volume<T>({2, {extent.size[0], extent.size[1], 1}}, slice), tau, options, context);
    });
    cost.cells += (extent.size[0] + 1) * (extent.size[1] + 1);
    cost.active += std::ssize(curves.segments);  // a square with two counts twice
    std::vector<std::int64_t> next(curves.points.size(), -1);
    for (const auto& [from, to] : curves.segments) next[static_cast<std::size_t>(from)] = to;
    std::vector<Contour> contours;
    for (std::size_t first = 0; first < next.size(); ++first) {
        std::vector<Vec3> corners;
        for (std::size_t at = first; next[at] >= 0;) {
            corners.push_back({curves.points[at][0], curves.points[at][1], static_cast<double>(z)});
            at = static_cast<std::size_t>(std::exchange(next[at], -1));
        }
        if (corners.size() >= 3) contours.push_back(contour_of(std::move(corners)));
    }
    return contours;
}

std::int64_t bytes_of(const std::vector<Contour>& contours) {
    std::size_t bytes = 0;
    for (const Contour& one : contours) bytes += sizeof(Contour) + one.corners.size() * (sizeof(Vec3) + sizeof(std::int64_t));
    return static_cast<std::int64_t>(bytes);
}

bool is_inside(const Vec3& p, const std::vector<Vec3>& polygon) {
    bool inside = false;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3 &q = polygon[i], &r = polygon[(i + 1) % polygon.size()];
        if ((q[1] > p[1]) != (r[1] > p[1]) && p[0] < q[0] + (p[1] - q[1]) / (r[1] - q[1]) * (r[0] - q[0])) inside = !inside;
    }
    return inside;
}

bool is_in_box(const Vec3& p, const Contour& contour) {
    return contour.low[0] <= p[0] && p[0] <= contour.high[0] && contour.low[1] <= p[1] && p[1] <= contour.high[1];
}

bool overlap(const Contour& p, const Contour& q) {
    if (p.is_hole != q.is_hole) return false;
    for (std::size_t axis = 0; axis < 2; ++axis) {
        if (p.low[axis] > q.high[axis] || q.low[axis] > p.high[axis]) return false;
    }
    const auto lies_in = [](const Contour& one, const Contour& other) {
        return std::ranges::any_of(one.corners,
                                   [&](const Vec3& corner) { return is_in_box(corner, other) && is_inside(corner, other.corners); });
    };
    return lies_in(p, q) || lies_in(q, p);
}

void add_points(std::vector<Contour>& contours, const Geometry& geometry, Surface& surface) {
    for (Contour& contour : contours) {
        for (const Vec3& corner : contour.corners) {
            contour.points.push_back(std::ssize(surface.points));
            surface.points.push_back(to_physical(geometry, corner));
        }
    }
}

/// Seen from outside the High side lies behind the strip: the lower polygon runs forwards along it.
void add_strip(const Contour& lower, const Contour& upper, Surface& surface) {
    const Strip strip = tile(lower.corners, upper.corners);
    std::size_t i = static_cast<std::size_t>(strip.start), j = 0;
    const std::size_t m = lower.points.size(), n = upper.points.size();
    for (const bool is_lower : strip.is_lower) {
        if (is_lower)
            surface.triangles.push_back({lower.points[i % m], lower.points[(i + 1) % m], upper.points[j % n]});
        else
            surface.triangles.push_back({lower.points[i % m], upper.points[(j + 1) % n], upper.points[j % n]});
        ++(is_lower ? i : j);
    }
}

}  // namespace

Extraction ConnectedContours::extract(double tau, const Context& context) const {
    Extraction result;
    std::vector<Contour> below;
    for (std::int64_t z = 0; z < volume_.info.extent.size[2]; ++z) {
        stop_if_cancelled(context);
        std::vector<Contour> contours = contours_of(volume_, z, tau, context, result.cost);
        add_points(contours, volume_.info.geometry, result.surface);
        for (const Contour& lower : below) {
            for (const Contour& upper : contours) {
                if (overlap(lower, upper)) add_strip(lower, upper, result.surface);
            }
        }
        result.cost.bytes = std::max(result.cost.bytes, bytes_of(below) + bytes_of(contours));
        below = std::move(contours);
    }
    return result;
}

}  // namespace isoatlas
