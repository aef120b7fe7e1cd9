// EdgePoints: the points of a surface, one for each edge between a High and a Low sample that it crosses.
#pragma once

#include <unordered_map>

#include "field/require_isovalue.h"
#include "isoatlas/error.h"
#include "isoatlas/surface.h"

namespace isoatlas {

/// Where tau lies between two samples, linearly: from is High, to is Low, and the point is at `from` where they are equal.
[[nodiscard]] inline double part_of_edge(double from, double to, double tau) { return (from - tau) / (from - to); }

/// Sample of a corner of a cell (field/cell.h).
[[nodiscard]] inline Index3 corner_of(const Index3& cell, int corner) {
    return {cell[0] + (corner & 1), cell[1] + (corner >> 1 & 1), cell[2] + (corner >> 2)};
}

template <class T>
class EdgePoints {
public:
    EdgePoints(const VolumeInfo& info, std::span<const T> samples, double tau, Surface& surface)
        : info_(info), samples_(samples), tau_(tau), surface_(surface) {}

    /// high, low: neighbouring samples, also across the diagonal of a face or a cell.
    std::int64_t point(const Index3& high, const Index3& low) {
        const Extent& extent = info_.extent;
        const std::int64_t from = extent.index(high), to = extent.index(low);
        const auto step = static_cast<std::uint64_t>((low[0] - high[0] + 1) + 3 * (low[1] - high[1] + 1) + 9 * (low[2] - high[2] + 1));
        const auto [at, is_new] = known_.emplace(static_cast<std::uint64_t>(from) * 27 + step, std::ssize(surface_.points));
        if (is_new) {
            const double part = part_of_edge(value(from), value(to), tau_);
            Vec3 position;
            for (std::size_t axis = 0; axis < 3; ++axis)
                position[axis] = static_cast<double>(high[axis]) + part * static_cast<double>(low[axis] - high[axis]);
            surface_.points.push_back(to_physical(info_.geometry, position));
        }
        return at->second;
    }
    /// A new point, in the middle of others.
    std::int64_t middle_of(std::span<const std::int64_t> points) {
        Vec3 sum{};
        for (const std::int64_t point : points) {
            for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += position(point)[axis] / static_cast<double>(points.size());
        }
        surface_.points.push_back(sum);
        return std::ssize(surface_.points) - 1;
    }
    [[nodiscard]] const Vec3& position(std::int64_t point) const { return surface_.points[static_cast<std::size_t>(point)]; }
    void add_triangle(std::int64_t p, std::int64_t q, std::int64_t r) { surface_.triangles.push_back({p, q, r}); }
    [[nodiscard]] double value(std::int64_t sample) const { return static_cast<double>(samples_[static_cast<std::size_t>(sample)]); }
    [[nodiscard]] double value(const Index3& sample) const { return value(info_.extent.index(sample)); }
    [[nodiscard]] bool is_high(const Index3& sample) const { return value(sample) >= tau_; }
    [[nodiscard]] double tau() const { return tau_; }
    /// Highs of a cell, a bit for each corner.
    [[nodiscard]] int pattern(const Index3& cell) const {
        int highs = 0;
        for (int corner = 0; corner < 8; ++corner) highs |= static_cast<int>(is_high(corner_of(cell, corner))) << corner;
        return highs;
    }
    /// Of the table of points: a node with two links each, and a pointer for each bucket.
    [[nodiscard]] std::int64_t bytes() const {
        constexpr std::size_t kNode = sizeof(typename decltype(known_)::value_type) + 2 * sizeof(void*);
        return static_cast<std::int64_t>(known_.size() * kNode + known_.bucket_count() * sizeof(void*));
    }

private:
    const VolumeInfo& info_;
    std::span<const T> samples_;
    double tau_;
    Surface& surface_;
    std::unordered_map<std::uint64_t, std::int64_t> known_;
};

}  // namespace isoatlas
