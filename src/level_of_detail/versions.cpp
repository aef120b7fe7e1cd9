#include "level_of_detail/versions.h"

#include <algorithm>
#include <cmath>

#include "geometry/vectors.h"
#include "level_of_detail/rules.h"

namespace isoatlas {
namespace {

void add_ball(ClusterGroup& group, const Vec3& centre, double radius) {
    group.radius = std::max(group.radius, norm(minus(centre, group.centre)) + radius);
}

}  // namespace

std::vector<std::size_t> split_in_clusters(std::span<TriangleCorners> triangles, std::int64_t max, std::span<const Vec3> points) {
    const auto centre = [&](const TriangleCorners& t, std::size_t axis) {
        return points[static_cast<std::size_t>(t[0])][axis] + points[static_cast<std::size_t>(t[1])][axis] +
               points[static_cast<std::size_t>(t[2])][axis];
    };
    std::vector<std::size_t> begins{0}, ends{triangles.size()};  // what is to be cut: the last one next
    while (!ends.empty()) {
        const std::size_t begin = begins.back(), end = ends.back();
        const std::size_t pieces = (end - begin + static_cast<std::size_t>(max) - 1) / static_cast<std::size_t>(max);
        if (pieces <= 1) {
            begins.push_back(end);
            ends.pop_back();
            continue;
        }
        Vec3 low{}, high{};
        for (std::size_t axis = 0; axis < 3; ++axis) low[axis] = INFINITY, high[axis] = -INFINITY;
        for (std::size_t i = begin; i < end; ++i) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double at = centre(triangles[i], axis);
                low[axis] = std::min(low[axis], at), high[axis] = std::max(high[axis], at);
            }
        }
        const Vec3 size = minus(high, low);
        const auto axis = static_cast<std::size_t>(std::ranges::max_element(size) - size.begin());
        const std::size_t middle = begin + (end - begin) * (pieces / 2) / pieces;
        const auto at = [&](std::size_t i) { return triangles.begin() + static_cast<std::ptrdiff_t>(i); };
        std::nth_element(at(begin), at(middle), at(end), [&](const TriangleCorners& a, const TriangleCorners& b) {
            const double first = centre(a, axis), second = centre(b, axis);
            return first != second ? first < second : a < b;
        });
        ends.push_back(middle);
    }
    return begins;
}

Versions::Versions(ClusterHierarchy& hierarchy, const SurfaceFrame& frame, const ClusterOptions& options, std::span<const Triangles> parts)
    : hierarchy_(hierarchy), frame_(frame), max_triangles_(options.triangles), scaled_(frame.scaled().begin(), frame.scaled().end()) {
    Surface& surface = hierarchy_.surface;
    Array<std::uint16_t> faces = frame.faces();
    mark_rims(CollapsibleMesh(surface.triangles, surface.points.size()), faces);
    faces_ = std::move(faces);
    BoundingBox all;
    double all_area = 0;
    for (const Vec3& p : scaled_) all.add(p);
    for (const TriangleCorners& t : surface.triangles) all_area += area(t);
    const double cell =
        std::sqrt(static_cast<double>(options.triangles * options.clusters) * all_area / static_cast<double>(surface.triangles.size()));
    places_.clear(all, std::max(cell, frame.step()));
    if (parts.empty()) {
        add_clusters(0, -1);
        return;
    }
    surface.triangles.clear();
    for (const Triangles& part : parts) {
        const std::size_t first = surface.triangles.size();
        surface.triangles.insert(surface.triangles.end(), part.begin(), part.end());
        add_clusters(first, -1);
    }
}

void Versions::add_clusters(std::size_t first, std::int64_t made_by) {
    const std::span<TriangleCorners> triangles = std::span(hierarchy_.surface.triangles).subspan(first);
    const std::vector<std::size_t> begins = split_in_clusters(triangles, max_triangles_, scaled_);
    for (std::size_t i = 0; i + 1 < begins.size(); ++i) {
        BoundingBox box;
        for (std::size_t t = begins[i]; t < begins[i + 1]; ++t) box.add(box_of(triangles[t]));
        const auto number = static_cast<std::int64_t>(hierarchy_.clusters.size());
        hierarchy_.clusters.push_back({.first_triangle = static_cast<std::int64_t>(first + begins[i]),
                                       .triangles = static_cast<std::int64_t>(begins[i + 1] - begins[i]),
                                       .made_by = made_by});
        boxes_.push_back(box);
        places_.add(static_cast<std::uint32_t>(number), box);
    }
}

std::int64_t Versions::add_group(std::span<const std::int64_t> clusters) {
    const auto number = static_cast<std::int64_t>(hierarchy_.groups.size());
    ClusterGroup group;
    BoundingBox box;
    for (const std::int64_t i : clusters) {
        Cluster& cluster = hierarchy_.clusters[static_cast<std::size_t>(i)];
        cluster.replaced_by = number;
        if (cluster.made_by >= 0) group.made_of.push_back(cluster.made_by);
        for (const TriangleCorners& t : triangles_of(cluster)) {
            for (const std::int64_t point : t) box.add(hierarchy_.surface.points[static_cast<std::size_t>(point)]);
        }
    }
    std::ranges::sort(group.made_of);
    const auto doubled = std::ranges::unique(group.made_of);
    group.made_of.erase(doubled.begin(), doubled.end());
    for (std::size_t axis = 0; axis < 3; ++axis) group.centre[axis] = (box.low[axis] + box.high[axis]) / 2;
    group.radius = norm(minus(box.high, group.centre));
    for (const std::int64_t i : group.made_of) {
        const ClusterGroup& part = hierarchy_.groups[static_cast<std::size_t>(i)];
        add_ball(group, part.centre, part.radius);
        group.distance = std::max(group.distance, part.distance);
    }
    hierarchy_.groups.push_back(std::move(group));
    return number;
}

void Versions::replace(std::int64_t group, const Replacement& by) {
    hierarchy_.groups[static_cast<std::size_t>(group)].distance += by.distance;
    Surface& surface = hierarchy_.surface;
    const auto first = static_cast<std::int64_t>(surface.points.size());
    for (const NewPoint& point : by.points) {
        const auto like = static_cast<std::size_t>(point.like);
        scaled_.push_back(point.scaled);
        faces_.push_back(point.faces);
        surface.points.push_back(point.physical);
        if (!surface.normals.empty()) surface.normals.push_back(point.normal);
        if (!surface.object.empty()) surface.object.push_back(std::int64_t{surface.object[like]});
        if (!surface.contour.empty()) surface.contour.push_back(std::int64_t{surface.contour[like]});
    }
    const std::size_t first_triangle = surface.triangles.size();
    for (TriangleCorners t : by.triangles) {
        for (std::int64_t& point : t) point = point < 0 ? first - 1 - point : point;
        surface.triangles.push_back(t);
    }
    add_clusters(first_triangle, group);
}

/// Of each group: is it replaced wherever this one is?
std::vector<std::uint8_t> Versions::replaced_with(std::int64_t group) const {
    std::vector<std::uint8_t> is_replaced(static_cast<std::size_t>(group) + 1, 0);
    is_replaced[static_cast<std::size_t>(group)] = 1;
    for (std::int64_t i = group; i >= 0; --i) {
        if (!is_replaced[static_cast<std::size_t>(i)]) continue;
        for (const std::int64_t part : hierarchy_.groups[static_cast<std::size_t>(i)].made_of)
            is_replaced[static_cast<std::size_t>(part)] = 1;
    }
    return is_replaced;
}

Triangles Versions::beside(std::int64_t group, const BoundingBox& box) const {
    const std::vector<std::uint8_t> is_replaced = replaced_with(group);
    std::vector<std::uint32_t> found;
    (void)places_.for_each(box, [&](std::uint32_t cluster) {
        const auto by = static_cast<std::size_t>(hierarchy_.clusters[cluster].replaced_by);  // none: a large number
        if ((by >= is_replaced.size() || !is_replaced[by]) && boxes_[cluster].meets(box)) found.push_back(cluster);
        return true;
    });
    std::ranges::sort(found);
    const auto doubled = std::ranges::unique(found);
    found.erase(doubled.begin(), doubled.end());
    Triangles triangles;
    for (const std::uint32_t cluster : found) {
        for (const TriangleCorners& t : triangles_of(hierarchy_.clusters[cluster])) {
            if (box_of(t).meets(box)) triangles.push_back(t);
        }
    }
    return triangles;
}

}  // namespace isoatlas
