// Surfaces of a hierarchy: the clusters at the border between groups that are chosen and groups that are not.
#include "level_of_detail/cluster_choice.h"

#include <algorithm>
#include <cmath>

#include "geometry/seen_lengths.h"
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

std::vector<double> pixels_of_groups(const ClusterHierarchy& hierarchy, const Viewpoint& from, double length) {
    const SeenLengths seen(from);
    if (!(length > 0)) throw Error(ErrorKind::usage, {.what = "the length of a unit is not positive", .expected = "more than 0"});
    std::vector<double> pixels;
    pixels.reserve(hierarchy.groups.size());
    for (const ClusterGroup& group : hierarchy.groups) {
        double most = seen.pixels(group.distance * length, group.centre, group.radius);
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
