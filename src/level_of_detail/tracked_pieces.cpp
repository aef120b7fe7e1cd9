#include "level_of_detail/tracked_pieces.h"

#include <bit>
#include <numeric>

#include "level_of_detail/collapsible_mesh.h"

namespace isoatlas {

TrianglePoints corners_of(const OriginalSurface& original, const Piece& piece) {
    TrianglePoints corners = original.corners(piece.triangle);
    for (int digit = (std::bit_width(piece.path) - 1) / 2; digit-- > 0;) corners = quarter_of(corners, piece.path >> (2 * digit) & 3U);
    return corners;
}

TrackedPieces::TrackedPieces(std::size_t triangles) {
    first_.resize(triangles);
    std::iota(first_.begin(), first_.end(), 0);
    next_ = first_;
}

void TrackedPieces::add(std::uint32_t triangle, const Piece& piece) {
    std::uint32_t added = piece.triangle;
    if (piece.path != 1) {
        added = static_cast<std::uint32_t>(first_.size() + quarters_.add({piece, kNone}));
    }
    std::uint32_t& first = first_[triangle];
    set_next(added, first == kNone ? added : next(first));
    if (first == kNone) {
        first = added;
    } else {
        set_next(first, added);
    }
}

}  // namespace isoatlas
