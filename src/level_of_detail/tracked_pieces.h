// Pieces of the original surface, which each present triangle tracks: triangles, and where a triangle is near several present ones,
// quarters of it, or quarters of those.
#pragma once

#include <cstdint>

#include "base/shared_vector.h"
#include "isoatlas/array.h"
#include "level_of_detail/original.h"

namespace isoatlas {

/// path: 1 for a whole triangle; of quarter k of another piece: four times its path, plus k.
struct Piece {
    std::uint32_t triangle;
    std::uint32_t path = 1;
    [[nodiscard]] Piece quarter(std::uint32_t k) const { return {triangle, 4 * path + k}; }
    [[nodiscard]] bool is_smallest() const { return path >= 64; }  ///< a 64th of a triangle
};
[[nodiscard]] TrianglePoints corners_of(const OriginalSurface& original, const Piece& piece);

/// A ring of pieces for each present triangle. Rings of different triangles may be changed at the same time.
class TrackedPieces {
public:
    TrackedPieces() = default;
    /// Every triangle tracks itself.
    explicit TrackedPieces(std::size_t triangles);

    /// Calls use(piece), until it returns false.
    template <class Use>
    bool for_each(std::uint32_t triangle, const Use& use) const {
        const std::uint32_t first = first_[triangle];
        if (first == kNone) return true;
        std::uint32_t i = first;
        do {
            if (!use(i < first_.size() ? Piece{i} : quarters_[i - first_.size()].piece)) return false;
            i = next(i);
        } while (i != first);
        return true;
    }
    void clear(std::uint32_t triangle) { first_[triangle] = kNone; }
    void add(std::uint32_t triangle, const Piece& piece);

private:
    struct Quarter {
        Piece piece;
        std::uint32_t next;
    };
    [[nodiscard]] std::uint32_t next(std::uint32_t i) const { return i < first_.size() ? next_[i] : quarters_[i - first_.size()].next; }
    void set_next(std::uint32_t i, std::uint32_t next) { (i < first_.size() ? next_[i] : quarters_[i - first_.size()].next) = next; }

    Array<std::uint32_t> first_;  ///< of a triangle: a piece of its ring, by number; kNone: there is none
    Array<std::uint32_t> next_;   ///< of a whole triangle
    SharedVector<Quarter> quarters_;
};

}  // namespace isoatlas
