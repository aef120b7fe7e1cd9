// Surfaces of a hierarchy: the clusters at the border between groups that are chosen and groups that are not.
#include "level_of_detail/cluster_choice.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "geometry/vectors.h"
#include "isoatlas/error.h"
#include "level_of_detail/without_points.h"

namespace isoatlas {
namespace {

/// The points that the triangles of these clusters use, in the order of the hierarchy.
Surface part_of(const ClusterHierarchy& hierarchy, const std::vector<std::int64_t>& clusters) {
    const Surface& all = hierarchy.surface;
    Surface part = without_points(all);
    std::vector<std::int64_t> place(all.points.size(), -1);
    for (const std::int64_t i : clusters) {
        const Cluster& cluster = hierarchy.clusters[static_cast<std::size_t>(i)];
        const std::span triangles =
            std::span(all.triangles).subspan(static_cast<std::size_t>(cluster.first_triangle), static_cast<std::size_t>(cluster.triangles));
        part.triangles.insert(part.triangles.end(), triangles.begin(), triangles.end());
        for (const auto& t : triangles) {
            for (const std::int64_t point : t) place[static_cast<std::size_t>(point)] = 0;
        }
    }
    for (std::size_t i = 0; i < place.size(); ++i) {
        if (place[i] < 0) continue;
        place[i] = static_cast<std::int64_t>(part.points.size());
        part.points.push_back(all.points[i]);
        if (!all.normals.empty()) part.normals.push_back(all.normals[i]);
        if (!all.object.empty()) part.object.push_back(all.object[i]);
        if (!all.contour.empty()) part.contour.push_back(all.contour[i]);
    }
    for (auto& t : part.triangles) {
        for (std::int64_t& point : t) point = place[static_cast<std::size_t>(point)];
    }
    return part;
}

std::vector<std::int64_t> clusters_within(const ClusterHierarchy& hierarchy, double distance) {
    return clusters_of_choice(hierarchy,
                              [&](std::int64_t group) { return hierarchy.groups[static_cast<std::size_t>(group)].distance <= distance; });
}

/// The cone of a viewpoint. Notation: s, c: sine and cosine of its half angle; a point is h along the axis and r beside it.
class SeenCone {
public:
    SeenCone(const Vec3& eye, const ViewCone& cone) : eye_(eye), sine_(std::sin(cone.half_angle)), cosine_(std::cos(cone.half_angle)) {
        const double length = norm(cone.direction);
        for (std::size_t axis = 0; axis < 3; ++axis) axis_[axis] = cone.direction[axis] / length;
    }
    /// The distance r c - h s from the mantle is at most that from the cone.
    [[nodiscard]] bool may_meet(const Vec3& centre, double radius) const {
        const Vec3 away = minus(centre, eye_);
        const double along = dot(away, axis_);
        const double beside = std::sqrt(std::max(0.0, dot(away, away) - along * along));
        return beside * cosine_ - along * sine_ <= radius;
    }

private:
    Vec3 eye_, axis_{};
    double sine_, cosine_;
};

}  // namespace

std::vector<std::int64_t> clusters_of_choice(const ClusterHierarchy& hierarchy, const std::function<bool(std::int64_t)>& is_chosen) {
    std::vector<std::uint8_t> chosen(hierarchy.groups.size(), 0);
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        const bool may_be = std::ranges::all_of(hierarchy.groups[i].made_of,
                                                [&](std::int64_t part) { return chosen[static_cast<std::size_t>(part)] != 0; });
        chosen[i] = may_be && is_chosen(static_cast<std::int64_t>(i)) ? 1 : 0;
    }
    const auto is_in = [&](std::int64_t group) { return group >= 0 && chosen[static_cast<std::size_t>(group)] != 0; };
    std::vector<std::int64_t> clusters;
    for (std::size_t i = 0; i < hierarchy.clusters.size(); ++i) {
        const Cluster& cluster = hierarchy.clusters[i];
        if ((cluster.made_by < 0 || is_in(cluster.made_by)) && !is_in(cluster.replaced_by))
            clusters.push_back(static_cast<std::int64_t>(i));
    }
    return clusters;
}

std::int64_t triangles_of(const ClusterHierarchy& hierarchy, const std::vector<std::int64_t>& clusters) {
    std::int64_t triangles = 0;
    for (const std::int64_t i : clusters) triangles += hierarchy.clusters[static_cast<std::size_t>(i)].triangles;
    return triangles;
}

std::int64_t triangles_within(const ClusterHierarchy& hierarchy, double distance) {
    return triangles_of(hierarchy, clusters_within(hierarchy, distance));
}

void require_viewpoint(const Viewpoint& from) {
    const auto require = [](bool holds, const char* what, const char* expected) {
        if (!holds) throw Error(ErrorKind::usage, {.what = what, .expected = expected});
    };
    require(from.pixel > 0 && from.near > 0, "a length of a view is not positive", "more than 0");
    if (!from.cone) return;
    const double length = norm(from.cone->direction);
    require(length > 0 && std::isfinite(length), "a view has no direction", "three finite numbers, not all 0");
    require(from.cone->half_angle > 0 && from.cone->half_angle < std::numbers::pi / 2, "the angle of a view",
            "above 0 and less than half a turn");
}

std::vector<double> pixels_of_groups(const ClusterHierarchy& hierarchy, const Viewpoint& from, double length) {
    require_viewpoint(from);
    if (!(length > 0)) throw Error(ErrorKind::usage, {.what = "the length of a unit is not positive", .expected = "more than 0"});
    constexpr double kUnseen = 1.0 / 16;  // coarse, and not so coarse that a turn of the view shows it before finer clusters are there
    std::optional<SeenCone> seen;
    if (from.cone) seen.emplace(from.eye, *from.cone);
    std::vector<double> pixels;
    pixels.reserve(hierarchy.groups.size());
    for (const ClusterGroup& group : hierarchy.groups) {
        const double away = norm(minus(group.centre, from.eye)) - group.radius;
        double most = group.distance * length / (from.pixel * std::max(away, from.near));
        if (seen && !seen->may_meet(group.centre, group.radius)) most *= kUnseen;
        for (const std::int64_t part : group.made_of) most = std::max(most, pixels[static_cast<std::size_t>(part)]);  // rounding
        pixels.push_back(most);
    }
    return pixels;
}

Surface surface_of_choice(const ClusterHierarchy& hierarchy, const std::function<bool(std::int64_t)>& is_chosen) {
    return part_of(hierarchy, clusters_of_choice(hierarchy, is_chosen));
}

Surface surface_within(const ClusterHierarchy& hierarchy, double distance) {
    return part_of(hierarchy, clusters_within(hierarchy, distance));
}

std::vector<SimplifiedSurface> coarser_surfaces(const ClusterHierarchy& hierarchy, std::int64_t most) {
    std::vector<double> distances;
    for (const ClusterGroup& group : hierarchy.groups) distances.push_back(group.distance);
    std::ranges::sort(distances);
    const auto doubled = std::ranges::unique(distances);
    distances.erase(doubled.begin(), doubled.end());
    std::vector<SimplifiedSurface> coarser;
    std::int64_t triangles = triangles_within(hierarchy, 0);
    for (const double distance : distances) {
        if (static_cast<std::int64_t>(coarser.size()) == most) break;
        const std::vector<std::int64_t> clusters = clusters_within(hierarchy, distance);
        const std::int64_t left = triangles_of(hierarchy, clusters);
        if (3 * left > triangles) continue;
        triangles = left;
        coarser.push_back({part_of(hierarchy, clusters), distance});
    }
    return coarser;
}

}  // namespace isoatlas
