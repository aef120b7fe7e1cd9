// The surface before it was simplified: is a point, is a triangle within a distance of it?
//
// Its triangles lie in a grid of cells, in two levels, of which only bins with triangles have cells.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "isoatlas/array.h"
#include "isoatlas/volume.h"
#include "level_of_detail/collapsible_mesh.h"

namespace isoatlas {

using TrianglePoints = std::array<Vec3, 3>;

/// The squared distance of p from a point of the triangle: from the nearest one, but for rounding.
[[nodiscard]] double squared_distance_bound(const Vec3& p, const TrianglePoints& triangle);

/// The middle of a triangle, and how far its corners are from there.
struct Ball {
    Vec3 centre;
    double radius;
};
[[nodiscard]] Ball ball_of(const TrianglePoints& triangle);

/// The triangle cut in four by the middles of its sides.
[[nodiscard]] std::array<TrianglePoints, 4> quarters_of(const TrianglePoints& triangle);
/// Quarter k of them.
[[nodiscard]] TrianglePoints quarter_of(const TrianglePoints& triangle, std::uint32_t k);

/// Is every point of `part` within a distance of `triangle`? It is convex, and so is the distance from it: largest in a corner of the part.
[[nodiscard]] inline bool is_near_all(const TrianglePoints& part, const TrianglePoints& triangle, double squared_distance) {
    for (const Vec3& p : part) {
        if (squared_distance_bound(p, triangle) > squared_distance) return false;
    }
    return true;
}

class OriginalSurface {
public:
    /// cell: edge of a cell, > 0; best that of a triangle or the distance that is asked for, whichever is larger. The spans are kept.
    OriginalSurface(std::span<const Vec3> points, std::span<const std::array<std::int64_t, 3>> triangles, double cell);

    /// Whether every point of the triangle lies within `distance` of the surface. Where that is not found before the triangle is cut into
    /// parts of a sixteenth of the distance: false.
    [[nodiscard]] bool covers(const TrianglePoints& triangle, double distance) const;
    [[nodiscard]] TrianglePoints corners(std::size_t triangle) const {
        const auto& [a, b, c] = triangles_[triangle];
        return {points_[static_cast<std::size_t>(a)], points_[static_cast<std::size_t>(b)], points_[static_cast<std::size_t>(c)]};
    }

    [[nodiscard]] const std::array<std::int64_t, 3>& triangle(std::size_t i) const { return triangles_[i]; }
    [[nodiscard]] const Vec3& point(std::size_t i) const { return points_[i]; }

    struct Nearest {
        std::uint32_t triangle;
        double squared_distance;
    };
    /// The triangle that is nearest to p, not farther than `limit`; kNone: none is.
    [[nodiscard]] Nearest nearest(const Vec3& p, double limit) const;

private:
    using Cell = std::array<std::int64_t, 3>;
    [[nodiscard]] Cell cell_of(const Vec3& p) const;
    [[nodiscard]] std::span<const std::uint32_t> triangles_in(const Cell& cell) const;
    void find_in(const Cell& cell, const Vec3& p, Nearest& best) const;
    template <class Use>
    void for_cells_near(const Vec3& p, double distance, const Use& use) const;
    void fill();

    std::span<const Vec3> points_;
    std::span<const std::array<std::int64_t, 3>> triangles_;
    Vec3 low_{};
    double per_cell_;
    Cell bins_{};                       ///< their number along each axis
    std::vector<std::uint32_t> bin_;    ///< the number of a bin among those with triangles, from 1; 0: it has none
    std::vector<std::uint64_t> first_;  ///< of each cell of the bins with triangles
    Array<std::uint32_t> found_;        ///< triangles, cell by cell
};

}  // namespace isoatlas
