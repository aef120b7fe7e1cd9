// Rule (b): the surface before and the one after stay within a distance of each other, both ways (docs/theory/10-level-of-detail.md).
//
// First by bounds: with n the normal of a triangle after, towards which all triangles after lie, every line along n through it meets the
// star before, whose points are at most as far from its plane as the farthest corner. The distances of the star before to the original
// surface grow by no more than that; the other way alike. Only where the bounds are used up are the distances measured.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "level_of_detail/star_deviation.h"

namespace isoatlas {

class DistanceRule {
public:
    explicit DistanceRule(DistanceState& state) : state_(state) {}

    /// Would both distances stay within the greatest one? state.scaled has the new place of the kept point; the star the old ones.
    [[nodiscard]] bool holds(const Star& star, const SurfaceState& state);
    /// After the collapse for which holds() was just true.
    void commit(const Star& star);

private:
    struct Part {  ///< a triangle after
        std::uint32_t number, b, c;
        std::size_t before, after;  ///< the parts around the apex beside it; at a rim itself
        std::array<Vec3, 3> corners;
        double bound;  ///< to the original surface
    };
    struct Moved {
        Piece piece;
        std::uint32_t triangle;
    };
    void make_parts(const Star& star, const SurfaceState& state);
    [[nodiscard]] bool measure(Part& part);
    [[nodiscard]] bool tracked_stay_near(const Star& star);
    [[nodiscard]] bool move(const Piece& tracked, std::size_t part);
    [[nodiscard]] bool move_whole(const Piece& piece, std::size_t part);

    DistanceState& state_;
    StarDeviation deviation_;
    std::vector<Part> parts_;
    std::vector<std::size_t> part_of_;  ///< of a triangle of the star: the one after in which it goes on
    std::vector<Moved> moved_;
};

}  // namespace isoatlas
