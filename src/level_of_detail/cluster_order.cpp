#include "level_of_detail/cluster_order.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace isoatlas {
namespace {

/// Of the surfaces from which a cluster is gone.
double end_of(const ClusterHierarchy& hierarchy, const Cluster& cluster) {
    if (cluster.replaced_by < 0) return std::numeric_limits<double>::infinity();
    return hierarchy.groups[static_cast<std::size_t>(cluster.replaced_by)].distance;
}

template <class Numbers>
void reorder(Numbers& numbers, std::span<const std::int64_t> order) {
    if (numbers.empty()) return;
    Numbers ordered;
    ordered.reserve(order.size());
    for (const std::int64_t i : order) ordered.push_back(numbers[static_cast<std::size_t>(i)]);
    numbers = std::move(ordered);
}

void order_clusters(ClusterHierarchy& hierarchy) {
    std::vector<std::int64_t> order(hierarchy.clusters.size());
    std::iota(order.begin(), order.end(), std::int64_t{0});
    std::ranges::stable_sort(order, std::greater{},
                             [&](std::int64_t i) { return end_of(hierarchy, hierarchy.clusters[static_cast<std::size_t>(i)]); });
    reorder(hierarchy.clusters, order);
    Array<std::array<std::int64_t, 3>> triangles;
    triangles.reserve(hierarchy.surface.triangles.size());
    for (Cluster& cluster : hierarchy.clusters) {
        const auto first = hierarchy.surface.triangles.begin() + cluster.first_triangle;
        cluster.first_triangle = static_cast<std::int64_t>(triangles.size());
        triangles.insert(triangles.end(), first, first + cluster.triangles);
    }
    hierarchy.surface.triangles = std::move(triangles);
}

void order_points(Surface& surface) {
    Array<std::int64_t> place(surface.points.size(), -1), order;
    for (auto& triangle : surface.triangles) {
        for (std::int64_t& point : triangle) {
            std::int64_t& found = place[static_cast<std::size_t>(point)];
            if (found < 0) found = static_cast<std::int64_t>(order.size()), order.push_back(point);
            point = found;
        }
    }
    reorder(surface.points, order), reorder(surface.normals, order);
    reorder(surface.object, order), reorder(surface.contour, order);
}

}  // namespace

void order_by_distance(ClusterHierarchy& hierarchy) {
    order_clusters(hierarchy);
    order_points(hierarchy.surface);
}

ClusterParts parts_beyond(const ClusterHierarchy& tables, std::span<const std::int64_t> points, double distance) {
    ClusterParts parts;
    for (const Cluster& cluster : tables.clusters) {
        if (!(end_of(tables, cluster) > distance)) break;
        parts.triangles += cluster.triangles, parts.points += points[static_cast<std::size_t>(parts.clusters)];
        ++parts.clusters;
    }
    return parts;
}

std::vector<std::int64_t> points_of_clusters(const ClusterHierarchy& hierarchy) {
    std::vector<std::int64_t> points;
    std::int64_t known = 0;
    for (const Cluster& cluster : hierarchy.clusters) {
        const std::int64_t before = known;
        for (std::int64_t t = cluster.first_triangle; t < cluster.first_triangle + cluster.triangles; ++t)
            known = std::max(known, std::ranges::max(hierarchy.surface.triangles[static_cast<std::size_t>(t)]) + 1);
        points.push_back(known - before);
    }
    return points;
}

}  // namespace isoatlas
