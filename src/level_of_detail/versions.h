// All versions of all parts of a surface, while its hierarchy is made: what is simplified later must not meet any that can be beside it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/triangle_tree.h"
#include "geometry/vectors.h"
#include "isoatlas/cluster_hierarchy.h"
#include "level_of_detail/surface_frame.h"
#include "level_of_detail/triangle_grid.h"

namespace isoatlas {

using Triangles = std::vector<TriangleCorners>;

/// A point of a simplified group that no version had before.
struct NewPoint {
    Vec3 scaled, physical;
    std::array<float, 3> normal;
    std::uint16_t faces;
    std::int64_t like;  ///< the point whose ids it has
};

/// What replaces a group: triangles of points of the versions, and of new ones: -1 is points[0], -2 is points[1].
struct Replacement {
    Triangles triangles;
    std::vector<NewPoint> points;
    double distance = 0;  ///< it and the group are at most so far apart, both ways
};

class Versions {
public:
    /// The exact surface in clusters, none of triangles of several parts; its points marked with the faces of the volume and the rims.
    /// parts: the triangles of the surface; empty: all are one part.
    Versions(ClusterHierarchy& hierarchy, const SurfaceFrame& frame, const ClusterOptions& options, std::span<const Triangles> parts);

    [[nodiscard]] std::span<const TriangleCorners> triangles_of(const Cluster& cluster) const {
        return std::span(hierarchy_.surface.triangles)
            .subspan(static_cast<std::size_t>(cluster.first_triangle), static_cast<std::size_t>(cluster.triangles));
    }
    [[nodiscard]] const ClusterHierarchy& hierarchy() const { return hierarchy_; }
    [[nodiscard]] const SurfaceFrame& frame() const { return frame_; }
    [[nodiscard]] const Vec3& scaled(std::int64_t point) const { return scaled_[static_cast<std::size_t>(point)]; }
    [[nodiscard]] std::uint16_t faces(std::int64_t point) const { return faces_[static_cast<std::size_t>(point)]; }
    [[nodiscard]] const BoundingBox& box(std::int64_t cluster) const { return boxes_[static_cast<std::size_t>(cluster)]; }
    [[nodiscard]] BoundingBox box_of(const TriangleCorners& triangle) const {
        return isoatlas::box_of(scaled(triangle[0]), scaled(triangle[1]), scaled(triangle[2]));
    }

    [[nodiscard]] double area(const TriangleCorners& triangle) const {  ///< scaled
        const auto& [a, b, c] = triangle;
        return norm(cross(minus(scaled(b), scaled(a)), minus(scaled(c), scaled(a)))) / 2;
    }

    /// A new group that replaces these clusters, without what replaces them. Returns its number.
    std::int64_t add_group(std::span<const std::int64_t> clusters);
    /// What replaces a group becomes clusters.
    void replace(std::int64_t group, const Replacement& by);
    /// Triangles in a box, of all clusters that can be beside what replaces a group.
    [[nodiscard]] Triangles beside(std::int64_t group, const BoundingBox& box) const;

private:
    /// Of the last triangles of the surface, from `first` on.
    void add_clusters(std::size_t first, std::int64_t made_by);
    [[nodiscard]] std::vector<std::uint8_t> replaced_with(std::int64_t group) const;

    ClusterHierarchy& hierarchy_;
    const SurfaceFrame& frame_;
    const std::int64_t max_triangles_;  ///< of a cluster
    Array<Vec3> scaled_;
    Array<std::uint16_t> faces_;
    std::vector<BoundingBox> boxes_;  ///< of each cluster, scaled
    TriangleGrid places_;             ///< of the clusters
};

/// Cuts triangles into clusters of at most `max`: in halves along the widest axis, until they are small enough. Orders the
/// triangles; returns where each cluster begins, and the end.
[[nodiscard]] std::vector<std::size_t> split_in_clusters(std::span<TriangleCorners> triangles, std::int64_t max,
                                                         std::span<const Vec3> points);

}  // namespace isoatlas
