// LevelSet: where the trilinear interpolant of a volume equals tau, and how far points are from it.
//
// On a box within a cell the interpolant lies between the values at the corners of the box, and takes all between. So a box has a part of
// the level set exactly where its corners do not all lie on one side; and along its edges the interpolant is linear, so that crossings
// there are points of the level set. The nearest boxes are halved until no box can be nearer than the nearest crossing found, but for the
// error: branch and bound. Nothing depends on where a search begins.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "field/cell.h"
#include "isoatlas/volume.h"
#include "methods/surfaces/edge_points.h"

namespace isoatlas {

inline double distance_between(const Vec3& p, const Vec3& q) { return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]); }

/// A cube within a cell, in voxel coordinates; values at its corners minus tau.
struct LevelBox {
    Vec3 from;
    double size;
    std::array<double, 8> value;
    double least = 0;  ///< distance from the point of a search

    [[nodiscard]] Vec3 corner(int k) const { return {from[0] + (k & 1) * size, from[1] + (k >> 1 & 1) * size, from[2] + (k >> 2) * size}; }
    [[nodiscard]] bool is_crossed() const {
        const auto [low, high] = std::ranges::minmax(value);
        return low <= 0 && high >= 0;
    }
    /// The level set in the box is at least so far from a point.
    [[nodiscard]] double distance_at_least(const Vec3& point) const {
        Vec3 nearest;
        for (std::size_t axis = 0; axis < 3; ++axis) nearest[axis] = std::clamp(point[axis], from[axis], from[axis] + size);
        return std::max(distance_between(point, nearest), distance_to_slab(point));
    }
    /// With the origin in its middle and its size as unit, the interpolant in the box is value + slope p + what products of coordinates
    /// add, `curved` at most. So the level set lies in the slab where value + slope p is that small.
    [[nodiscard]] double distance_to_slab(const Vec3& point) const {
        std::array<double, 8> sum{};  // bit a of the index: with the sign of coordinate a
        for (unsigned k = 0; k < 8; ++k) {
            for (unsigned signs = 0; signs < 8; ++signs) sum[signs] += std::popcount(~k & signs) % 2 != 0 ? -value[k] : value[k];
        }
        const Vec3 slope{sum[1] / 4, sum[2] / 4, sum[4] / 4};
        const double curved = (std::abs(sum[3]) + std::abs(sum[5]) + std::abs(sum[6]) + std::abs(sum[7])) / 8;
        double there = sum[0] / 8;
        for (std::size_t axis = 0; axis < 3; ++axis) there += slope[axis] * ((point[axis] - from[axis]) / size - 0.5);
        const double steepness = std::hypot(slope[0], slope[1], slope[2]);
        return steepness > 0 ? size * (std::abs(there) - curved) / steepness : 0;
    }
    /// The interpolant at a place in the box, 0 to 1.
    [[nodiscard]] double value_at(const Vec3& part) const {
        std::array<double, 8> v = value;
        for (std::size_t axis = 3, count = 4; axis-- > 0; count /= 2) {
            for (std::size_t k = 0; k < count; ++k) v[k] += part[axis] * (v[k + count] - v[k]);
        }
        return v[0];
    }
    [[nodiscard]] LevelBox half(int k) const {
        LevelBox box{corner(k), size / 2, {}};
        for (std::size_t axis = 0; axis < 3; ++axis) box.from[axis] = from[axis] + ((k >> axis & 1) != 0 ? size / 2 : 0);
        for (int c = 0; c < 8; ++c) {
            const auto part = [&](int axis) { return ((k >> axis & 1) + (c >> axis & 1)) * 0.5; };
            box.value[static_cast<std::size_t>(c)] = value_at({part(0), part(1), part(2)});
        }
        return box;
    }
    /// Distance from a point to the nearest crossing of an edge.
    [[nodiscard]] double distance_to_crossings(const Vec3& point) const {
        double least_found = std::numeric_limits<double>::infinity();
        for (const auto& [a, b] : kEdgeCorners) {
            const double u = value[static_cast<std::size_t>(a)], v = value[static_cast<std::size_t>(b)];
            if ((u < 0) == (v < 0) && u != 0 && v != 0) continue;
            Vec3 at = corner(a);
            const Vec3 end = corner(b);
            for (std::size_t axis = 0; axis < 3; ++axis) at[axis] += u == v ? 0 : u / (u - v) * (end[axis] - at[axis]);
            least_found = std::min(least_found, distance_between(point, at));
        }
        return least_found;
    }
};

/// The samples are borrowed.
template <class T>
class LevelSet {
public:
    LevelSet(const Extent& extent, std::span<const T> samples, double tau) : extent_(extent), samples_(samples), tau_(tau) {}

    [[nodiscard]] Index3 cells() const { return extent_.size - 1; }
    [[nodiscard]] LevelBox box(const Index3& cell) const {
        LevelBox box{{static_cast<double>(cell[0]), static_cast<double>(cell[1]), static_cast<double>(cell[2])}, 1, {}};
        for (int k = 0; k < 8; ++k) {
            const std::int64_t sample = extent_.index(corner_of(cell, k));
            box.value[static_cast<std::size_t>(k)] = static_cast<double>(samples_[static_cast<std::size_t>(sample)]) - tau_;
        }
        return box;
    }

    /// From a point to the level set: to a point of it, that is at most `error`, or a hundredth, farther away than the nearest. max: the
    /// distance is at least that.
    [[nodiscard]] double distance(const Vec3& point, double error, double max) const {
        if (cells().product() == 0) return max;
        Search search{point, error, max, {}};
        Index3 middle;
        for (std::size_t axis = 0; axis < 3; ++axis)
            middle[axis] = std::clamp<std::int64_t>(static_cast<std::int64_t>(std::floor(point[axis])), 0, extent_.size[axis] - 2);
        for (std::int64_t radius = 0;; ++radius) {
            add_shell(middle, radius, search);
            double beyond = max;  // what is not in the shells yet is at least so far away
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double below = point[axis] - static_cast<double>(middle[axis] - radius);
                if (middle[axis] - radius > 0) beyond = std::min(beyond, below);
                if (middle[axis] + radius + 2 < extent_.size[axis]) beyond = std::min(beyond, static_cast<double>(2 * radius + 1) - below);
            }
            search.run(beyond);
            if (search.is_good(beyond)) return search.best;
        }
    }

private:
    struct Search {
        Vec3 point;
        double error, best;
        std::vector<LevelBox> boxes;  ///< a heap, the nearest first

        static bool is_farther(const LevelBox& p, const LevelBox& q) { return p.least > q.least; }
        /// Is the best one good enough where nothing is nearer than this?
        [[nodiscard]] bool is_good(double least) const { return best - std::max(error, 0.01 * best) <= least; }
        void add(LevelBox box) {
            if (!box.is_crossed()) return;
            box.least = box.distance_at_least(point);
            if (is_good(box.least)) return;
            boxes.push_back(box);
            std::ranges::push_heap(boxes, is_farther);
        }
        /// Halves boxes that are nearer than this.
        void run(double beyond) {
            while (!boxes.empty() && boxes.front().least < beyond && !is_good(boxes.front().least)) {
                std::ranges::pop_heap(boxes, is_farther);
                const LevelBox box = boxes.back();
                boxes.pop_back();
                best = std::min(best, box.distance_to_crossings(point));
                if (box.size < 1e-9) continue;  // rounding
                for (int k = 0; k < 8; ++k) add(box.half(k));
            }
        }
    };

    /// Cells at this distance from one, counted along the axis where it is greatest.
    void add_shell(const Index3& middle, std::int64_t radius, Search& search) const {
        Index3 low, high;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            low[axis] = std::max<std::int64_t>(0, middle[axis] - radius);
            high[axis] = std::min(extent_.size[axis] - 2, middle[axis] + radius);
        }
        for (std::int64_t z = low[2]; z <= high[2]; ++z) {
            for (std::int64_t y = low[1]; y <= high[1]; ++y) {
                const bool is_whole = std::abs(z - middle[2]) == radius || std::abs(y - middle[1]) == radius;
                for (std::int64_t x = low[0]; x <= high[0]; ++x) {
                    if (is_whole || std::abs(x - middle[0]) == radius) search.add(box({x, y, z}));
                }
            }
        }
    }

    Extent extent_;
    std::span<const T> samples_;
    double tau_;
};

}  // namespace isoatlas
