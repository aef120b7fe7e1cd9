// PointTable: numbers distinct positions in order of first appearance; welds formats without shared points.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "isoatlas/array.h"

namespace isoatlas {

class PointTable {
public:
    using Point = std::array<double, 3>;

    /// The number of this position (-0.0 equals 0.0; no NaN). Amortised O(1).
    [[nodiscard]] std::int64_t number(Point p) {
        for (double& x : p) x += 0.0;  // -0.0 + 0.0 == 0.0
        if (2 * (points_.size() + 1) > slots_.size()) grow();
        std::size_t slot = slot_of(p);
        while (slots_[slot] >= 0 && points_[static_cast<std::size_t>(slots_[slot])] != p) slot = (slot + 1) & (slots_.size() - 1);
        if (slots_[slot] < 0) {
            slots_[slot] = static_cast<std::int64_t>(points_.size());
            points_.push_back(p);
        }
        return slots_[slot];
    }
    [[nodiscard]] Array<Point> take_points() { return std::move(points_); }

private:
    [[nodiscard]] std::size_t slot_of(const Point& p) const {
        std::uint64_t h = 0;
        for (const double x : p) {
            h = (h ^ std::bit_cast<std::uint64_t>(x)) * 0x9e3779b97f4a7c15U;
            h ^= h >> 32;
        }
        return static_cast<std::size_t>(h) & (slots_.size() - 1);
    }
    void grow() {
        slots_.assign(slots_.empty() ? 64 : 2 * slots_.size(), -1);
        for (std::size_t i = 0; i < points_.size(); ++i) {
            std::size_t slot = slot_of(points_[i]);
            while (slots_[slot] >= 0) slot = (slot + 1) & (slots_.size() - 1);
            slots_[slot] = static_cast<std::int64_t>(i);
        }
    }

    Array<Point> points_;
    std::vector<std::int64_t> slots_;  ///< open addressing; -1: free; a power of two, at most half full
};

}  // namespace isoatlas
