#include "level_of_detail/collapsible_mesh.h"

#include <algorithm>

namespace isoatlas {

CollapsibleMesh::CollapsibleMesh(std::span<const std::array<std::int64_t, 3>> triangles, std::size_t points) {
    corners_.resize(3 * triangles.size());
    next_.resize(3 * triangles.size());
    fan_.assign(points, kNone);
    for (std::size_t corner = corners_.size(); corner-- > 0;) {
        const auto point = static_cast<std::uint32_t>(triangles[corner / 3][corner % 3]);
        corners_[corner] = point;
        next_[corner] = fan_[point];
        fan_[point] = static_cast<std::uint32_t>(corner);
    }
}

void CollapsibleMesh::collapse(std::uint32_t gone, std::uint32_t kept) {
    std::uint32_t corner = fan_[gone];
    fan_[gone] = kNone;
    while (corner != kNone) {
        const std::uint32_t following = next_[corner];
        if (corners_[corner] == gone) {
            const std::uint32_t next = next_corner(corner), last = last_corner(corner);
            if (corners_[next] == kept || corners_[last] == kept) {
                corners_[corner] = corners_[next] = corners_[last] = kNone;
            } else {
                corners_[corner] = kept;
                next_[corner] = fan_[kept];
                fan_[kept] = corner;
            }
        }
        corner = following;
    }
    std::uint32_t* link = &fan_[kept];  // corners of triangles that are gone leave the list
    while (*link != kNone) {
        if (corners_[*link] == kept) {
            link = &next_[*link];
        } else {
            *link = next_[*link];
        }
    }
}

}  // namespace isoatlas
