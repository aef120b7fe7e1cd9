// FrontHits: the hits that are points of a front, each of them once.
//
//   line   the edges of the grid along an axis that begin in one of its rows
//   owner  of a line: the row of blocks (octree_front/front_leaves.h) in which it begins, by y and z
//
// Points are in the order of their owners, in each in that of z, y, axis, x.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/hits.h"
#include "octree_front/leaf_loop.h"

namespace isoatlas {

class FrontHits {
public:
    /// leaves: outlives this.
    explicit FrontHits(const FrontLeaves& leaves);

    /// Keeps those hits of a row of blocks that it owns, in any order, many times or once; those it does not own their owner has, too.
    /// Several threads, each row once. Cost: O(hits) and some hundred operations.
    void keep(std::int64_t row, std::span<const EdgeHit> hits);
    /// After the last keep(): gives all hits their points. Returns how many there are.
    std::int64_t number();
    /// Cost: O(1), but for hits on one line near each other.
    [[nodiscard]] std::int64_t point_of(const EdgeHit& hit) const;
    /// Calls visit(first y, first z, lines) for the hits that a row of blocks owns, by bundles of lines (mesh/bundle_samples.h).
    template <class Visit>
    void for_bundles(std::int64_t row, const Visit& visit) const;

private:
    struct Row {
        std::vector<std::size_t> begin;      ///< of each line, in `position`; and the end of the last
        std::vector<std::int32_t> position;  ///< along x
        std::int64_t point = 0;              ///< the first one
    };
    /// In its owner.
    [[nodiscard]] std::size_t line_of(const EdgeHit& hit) const {
        const std::int64_t mask = (std::int64_t{1} << shift_) - 1;
        return static_cast<std::size_t>(3 * ((hit.position[2] & mask) << shift_ | (hit.position[1] & mask)) + hit.axis);
    }
    [[nodiscard]] std::int64_t owner_of(const EdgeHit& hit) const {
        return (hit.position[1] >> shift_) + rows_y_ * (hit.position[2] >> shift_);
    }

    int shift_;                    ///< log2 of the lines of a row of blocks along y and along z
    std::int64_t rows_y_, words_;  ///< rows of blocks along y; words of 64 positions of a line
    std::vector<Row> rows_;
};

template <class Visit>
void FrontHits::for_bundles(std::int64_t row, const Visit& visit) const {
    const Row& of = rows_[static_cast<std::size_t>(row)];
    if (of.position.empty()) return;
    const std::int64_t width = std::int64_t{1} << shift_, first_y = (row % rows_y_) * width - 1, first_z = (row / rows_y_) * width - 1;
    std::vector<HitLine> lines;
    for (std::int64_t y_begin = 0; y_begin < width; y_begin += kBundleSize[1]) {
        lines.clear();
        for (std::int64_t z = 0; z < width; ++z) {
            for (std::int64_t y = y_begin; y < std::min(width, y_begin + kBundleSize[1]); ++y) {
                const std::size_t* const begin = &of.begin[static_cast<std::size_t>(3 * (z << shift_ | y))];
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    if (begin[axis] == begin[axis + 1]) continue;
                    lines.push_back({first_y + y, first_z + z, axis,
                                     std::span(of.position).subspan(begin[axis], begin[axis + 1] - begin[axis]),
                                     of.point + static_cast<std::int64_t>(begin[axis])});
                }
            }
        }
        if (!lines.empty()) visit(first_y + y_begin, first_z, lines);
    }
}

}  // namespace isoatlas
