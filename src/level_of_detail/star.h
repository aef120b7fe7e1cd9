// The star of an edge: the triangles around its two points, before and after it is collapsed.
//
// Notation: the edge (gone, kept) becomes the point `kept` at a new place. Of its triangles those with both points disappear; the others
// get `kept` as their apex.
#pragma once

#include <cstdint>
#include <vector>

#include "level_of_detail/rules.h"

namespace isoatlas {

/// b, c: the points after the apex in the order of the triangle. One that disappears: apex is gone or kept, and b or c is the other.
struct StarTriangle {
    std::uint32_t number, apex, b, c;
    bool disappears;
};

struct Star {
    std::uint32_t gone = kNone, kept = kNone;
    std::vector<StarTriangle> triangles;
    std::vector<std::uint32_t> ring;  ///< the points around the edge
    Vec3 gone_scaled{}, kept_scaled{}, new_scaled{};
    Vec3 gone_point{}, kept_point{}, new_point{};

    /// The triangles around an edge. Does its collapse keep the topology? The links of the points share the points opposite of the edge
    /// and nothing else (Dey et al. 1999). Of two points at a rim, beyond which one point more is imagined, only an edge of the rim itself
    /// is collapsed.
    [[nodiscard]] bool find(const CollapsibleMesh& mesh, std::uint32_t of_gone, std::uint32_t of_kept, bool are_at_rim);
};

}  // namespace isoatlas
