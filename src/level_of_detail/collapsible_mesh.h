// A triangle mesh whose edges are collapsed: triangles by their corners, and the fan of triangles around each point.
//
// Notation: corner 3 t + k is corner k of triangle t; the fan of a point is the list of its corners.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "isoatlas/array.h"
#include "isoatlas/surface.h"

namespace isoatlas {

inline constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

[[nodiscard]] constexpr std::uint32_t next_corner(std::uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }
[[nodiscard]] constexpr std::uint32_t last_corner(std::uint32_t corner) { return corner % 3 == 0 ? corner + 2 : corner - 1; }

class CollapsibleMesh {
public:
    explicit CollapsibleMesh(std::span<const std::array<std::int64_t, 3>> triangles, std::size_t points);

    [[nodiscard]] std::size_t triangles() const { return corners_.size() / 3; }  ///< those that are gone too
    [[nodiscard]] std::size_t points() const { return fan_.size(); }
    [[nodiscard]] bool has_triangle(std::uint32_t t) const { return corners_[3 * static_cast<std::size_t>(t)] != kNone; }
    [[nodiscard]] bool has_point(std::uint32_t point) const { return fan_[point] != kNone; }
    [[nodiscard]] std::uint32_t point(std::uint32_t corner) const { return corners_[corner]; }
    [[nodiscard]] std::array<std::uint32_t, 3> triangle(std::uint32_t t) const {
        const std::size_t first = 3 * static_cast<std::size_t>(t);
        return {corners_[first], corners_[first + 1], corners_[first + 2]};
    }

    /// Calls use(corner) for the corners of a point. For different points at the same time, as long as none is collapsed.
    template <class Use>
    void for_fan(std::uint32_t point, const Use& use) const {
        for (std::uint32_t corner = fan_[point]; corner != kNone; corner = next_[corner]) {
            if (corners_[corner] == point) use(corner);
        }
    }

    /// Joins `gone` with `kept`, whose common triangles disappear.
    void collapse(std::uint32_t gone, std::uint32_t kept);

private:
    Array<std::uint32_t> corners_;  ///< their points; kNone: of a triangle that is gone
    Array<std::uint32_t> next_;     ///< of a corner: another one in the fan of its point
    Array<std::uint32_t> fan_;      ///< of a point: a corner
};

}  // namespace isoatlas
