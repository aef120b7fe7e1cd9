// The triangles of a block of a mesh that changes, by the cells that their boxes meet.
//
// A triangle that has changed is added to the cells that it meets now and did not meet before; what is found in a cell may have left it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "geometry/triangle_tree.h"
#include "level_of_detail/collapsible_mesh.h"

namespace isoatlas {

[[nodiscard]] inline BoundingBox box_of(const Vec3& a, const Vec3& b, const Vec3& c) {
    BoundingBox box;
    box.add(a);
    box.add(b);
    box.add(c);
    return box;
}

class TriangleGrid {
public:
    /// Of triangles that meet `box`, in cells of about this edge.
    void clear(const BoundingBox& box, double cell);
    void add(std::uint32_t triangle, const BoundingBox& box) { add(triangle, box, nullptr); }
    /// A triangle that had the box `before`.
    void move(std::uint32_t triangle, const BoundingBox& before, const BoundingBox& now) { add(triangle, now, &before); }

    /// Calls use(triangle) for all triangles in the cells that meet `box`, for some more than once, until one returns false.
    template <class Use>
    bool for_each(const BoundingBox& box, const Use& use) const {
        const Range range = range_of(box);
        std::array<std::int64_t, 3> cell{};
        for (cell[2] = range.first[2]; cell[2] <= range.last[2]; ++cell[2]) {
            for (cell[1] = range.first[1]; cell[1] <= range.last[1]; ++cell[1]) {
                for (cell[0] = range.first[0]; cell[0] <= range.last[0]; ++cell[0]) {
                    for (std::uint32_t entry = heads_[place(cell)]; entry != kNone; entry = entries_[entry].next) {
                        if (!use(entries_[entry].triangle)) return false;
                    }
                }
            }
        }
        return true;
    }

private:
    struct Range {
        std::array<std::int64_t, 3> first, last;
        [[nodiscard]] bool holds(const std::array<std::int64_t, 3>& cell) const {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                if (cell[axis] < first[axis] || cell[axis] > last[axis]) return false;
            }
            return true;
        }
    };
    struct Entry {
        std::uint32_t triangle, next;
    };
    [[nodiscard]] Range range_of(const BoundingBox& box) const;
    [[nodiscard]] std::size_t place(const std::array<std::int64_t, 3>& cell) const {
        return static_cast<std::size_t>((cell[2] * cells_[1] + cell[1]) * cells_[0] + cell[0]);
    }
    void add(std::uint32_t triangle, const BoundingBox& box, const BoundingBox* before);

    Vec3 low_{};
    double per_cell_ = 1;
    std::array<std::int64_t, 3> cells_{};
    std::vector<std::uint32_t> heads_;
    std::vector<Entry> entries_;
};

}  // namespace isoatlas
