#include "level_of_detail/triangle_grid.h"

namespace isoatlas {

void TriangleGrid::clear(const BoundingBox& box, double cell) {
    constexpr std::int64_t kMaxCells = std::int64_t{1} << 24;
    low_ = box.low;
    std::int64_t count = 0;
    do {
        per_cell_ = 1 / cell;
        count = 1;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            cells_[axis] = static_cast<std::int64_t>((box.high[axis] - box.low[axis]) * per_cell_) + 1;
            count *= cells_[axis];
        }
        cell *= 2;
    } while (count > kMaxCells);
    heads_.assign(static_cast<std::size_t>(count), kNone);
    entries_.clear();
}

TriangleGrid::Range TriangleGrid::range_of(const BoundingBox& box) const {
    Range range{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto cell_at = [&](double coordinate) {
            const double cell = std::floor((coordinate - low_[axis]) * per_cell_);
            return static_cast<std::int64_t>(std::clamp(cell, 0.0, static_cast<double>(cells_[axis] - 1)));
        };
        range.first[axis] = cell_at(box.low[axis]), range.last[axis] = cell_at(box.high[axis]);
    }
    return range;
}

void TriangleGrid::add(std::uint32_t triangle, const BoundingBox& box, const BoundingBox* before) {
    const Range range = range_of(box);
    const Range old = before ? range_of(*before) : Range{{1, 1, 1}, {0, 0, 0}};
    std::array<std::int64_t, 3> cell{};
    for (cell[2] = range.first[2]; cell[2] <= range.last[2]; ++cell[2]) {
        for (cell[1] = range.first[1]; cell[1] <= range.last[1]; ++cell[1]) {
            for (cell[0] = range.first[0]; cell[0] <= range.last[0]; ++cell[0]) {
                if (old.holds(cell)) continue;
                std::uint32_t& head = heads_[place(cell)];
                entries_.push_back({triangle, head});
                head = static_cast<std::uint32_t>(entries_.size() - 1);
            }
        }
    }
}

}  // namespace isoatlas
