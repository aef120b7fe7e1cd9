// How far the star of an edge moves when it is collapsed: the largest distance along one direction between the triangles before and after.
#pragma once

#include <vector>

#include "level_of_detail/star.h"

namespace isoatlas {

class StarDeviation {
public:
    /// A distance at most from every point of the triangles after to those before, and back; infinity where they do not all face one
    /// way, and at a rim.
    /// state.scaled has the new place of the kept point; the star the old ones.
    ///
    /// Seen along a direction n towards which all triangles before and after face, the triangles after go once around their apex, so that
    /// the ring is a polygon without crossings; the triangles before, of the same ring, cover it once too. Both are graphs of functions
    /// that are linear in the pieces into which their sides cut the polygon. The difference is largest in a corner of a piece: an old
    /// point, the new one, or where a side before crosses a side after.
    [[nodiscard]] double find(const Star& star, const SurfaceState& state);
    /// Behind a finite find(): does triangle i of the star, seen along the direction, have more than a side in common with the j-th of the
    /// triangles after?
    [[nodiscard]] bool overlap(std::size_t i, std::size_t j) const;

private:
    struct Place {
        double u, v, height;
    };
    struct Triangle {
        Place a, b, c;
    };
    [[nodiscard]] static bool is_separated(const Triangle& t, const Triangle& other);
    [[nodiscard]] bool project(const Star& star, const SurfaceState& state);
    [[nodiscard]] static double height_difference(const Place& p, const std::vector<Triangle>& triangles);
    [[nodiscard]] double at_crossings() const;

    std::vector<Triangle> before_, after_;
    std::vector<std::array<Place, 2>> sides_before_, sides_after_;
    Place gone_{}, kept_{}, new_{};
};

}  // namespace isoatlas
