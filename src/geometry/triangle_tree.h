// TriangleTree: boxes around boxes around the triangles of a mesh, to find those near a point or a box.
//
// In the literature: bounding volume hierarchy. Triangles are halved at the median of their centres along the widest axis, so that the tree
// is complete and needs no pointers: node i of a level has the nodes 2 i and 2 i + 1 of the level below.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "base/big_vector.h"
#include "geometry/triangles.h"

namespace isoatlas {

using TriangleCorners = std::array<std::int64_t, 3>;

struct BoundingBox {
    Vec3 low{kInfinite, kInfinite, kInfinite}, high{-kInfinite, -kInfinite, -kInfinite};  ///< empty

    void add(const Vec3& p) {
        for (std::size_t i = 0; i < 3; ++i) low[i] = std::min(low[i], p[i]), high[i] = std::max(high[i], p[i]);
    }
    void add(const BoundingBox& box) { add(box.low), add(box.high); }
    [[nodiscard]] bool meets(const BoundingBox& box) const {
        for (std::size_t i = 0; i < 3; ++i)
            if (high[i] < box.low[i] || box.high[i] < low[i]) return false;
        return true;
    }
    [[nodiscard]] double squared_distance(const Vec3& p) const {
        double sum = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const double outside = std::max({low[i] - p[i], p[i] - high[i], 0.0});
            sum += outside * outside;
        }
        return sum;
    }

private:
    static constexpr double kInfinite = std::numeric_limits<double>::infinity();
};

struct NearTriangle {
    std::int64_t triangle = -1;  ///< none
    NearestPoint nearest{{}, std::numeric_limits<double>::infinity()};
};

/// The mesh must live as long as the tree; finite coordinates. Memory: 32 bytes a triangle, 56 while it is made.
/// Cost of making it: some 0.5 microseconds a triangle. The same tree for any number of threads.
class TriangleTree {
public:
    TriangleTree(std::span<const Vec3> points, std::span<const TriangleCorners> triangles, int threads);

    static constexpr std::size_t kLeaf = 4;  ///< triangles of a leaf

    /// The triangle nearest to p, or `known` if none is nearer. A good guess saves most of the time: about a microsecond.
    [[nodiscard]] NearTriangle nearest(const Vec3& p, NearTriangle known = {}) const;
    /// That triangle as a guess for nearest().
    [[nodiscard]] NearTriangle near(const Vec3& p, std::int64_t triangle) const { return {triangle, nearest_point(p, corners(triangle))}; }

    [[nodiscard]] std::array<Vec3, 3> corners(std::int64_t triangle) const {
        const TriangleCorners& t = triangles_[static_cast<std::size_t>(triangle)];
        return {points_[static_cast<std::size_t>(t[0])], points_[static_cast<std::size_t>(t[1])], points_[static_cast<std::size_t>(t[2])]};
    }
    [[nodiscard]] std::size_t leaves() const { return levels_[0].size(); }
    [[nodiscard]] std::span<const std::int64_t> leaf(std::size_t i) const {
        return std::span(order_).subspan(i * kLeaf, std::min(kLeaf, order_.size() - i * kLeaf));
    }
    [[nodiscard]] const BoundingBox& leaf_box(std::size_t i) const { return levels_[0][i]; }

    /// Calls visit(leaf) for every leaf from number `first` on whose box meets a box.
    template <class Visit>
    void for_each_leaf(const BoundingBox& box, std::size_t first, Visit&& visit) const {
        std::vector<Node> open;
        if (!order_.empty()) open.push_back({levels_.size() - 1, 0});
        while (!open.empty()) {
            const Node node = open.back();
            open.pop_back();
            if ((node.number + 1) << node.level <= first || !levels_[node.level][node.number].meets(box)) continue;
            if (node.level == 0) {
                visit(node.number);
                continue;
            }
            for (const std::size_t child : {2 * node.number + 1, 2 * node.number})
                if (child < levels_[node.level - 1].size()) open.push_back({node.level - 1, child});
        }
    }

private:
    struct Node {
        std::size_t level, number;
    };

    std::span<const Vec3> points_;
    std::span<const TriangleCorners> triangles_;
    BigVector<std::int64_t> order_;               // triangles, leaf by leaf
    std::vector<BigVector<BoundingBox>> levels_;  // leaves first; the last has one node, unless there is no triangle
};

}  // namespace isoatlas
