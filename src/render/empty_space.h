// Empty-space skipping: min-max blocks of cells, and traversal of the visible ones by a ray.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "isoatlas/volume.h"
#include "render/transfer.h"

namespace isoatlas {

/// Lowest and highest sample of every block of kSide^3 cells, x fastest. Neighbours share the samples between them.
struct BlockRanges {
    static constexpr std::int64_t kSide = 8;
    Index3 count{};
    std::vector<std::array<double, 2>> ranges;

    [[nodiscard]] std::array<double, 2> whole() const;
};
/// Cost: reads every sample once or twice.
[[nodiscard]] BlockRanges block_ranges(const Volume& volume, int threads);

class EmptySpaceGrid {
public:
    EmptySpaceGrid(const BlockRanges& blocks, const Transfer& transfer, int threads);

    /// Calls visit(from, to) for each stretch of a ray (origin and way in samples, begin <= t <= end inside of the volume) in blocks where
    /// something is visible, in order, until it returns false. A stretch shorter than `min` may be skipped.
    template <class Visit>
    void walk(const Vec3& origin, const Vec3& way, double begin, double end, double min, const Visit& visit) const {
        const Leaps leaps(*this, origin, way);
        bool inside = false;
        double since = begin, t = begin;
        while (t < end) {
            const auto [visible, leave] = leaps.from(t + min);
            if (inside && !visible && !visit(since, t)) return;
            if (!inside && visible) since = t;
            inside = visible;
            t = std::max(leave, t + min);
        }
        if (inside) visit(since, end);
    }

private:
    /// Exit points of a ray from blocks, or from cubes of empty blocks (Zuiderveld, Koning, Viergever: Acceleration of ray casting
    /// using 3D distance transforms, 1992).
    struct Leaps {
        Leaps(const EmptySpaceGrid& blocks, const Vec3& o, const Vec3& w) : all(blocks) {
            constexpr double kBlock = 1.0 / static_cast<double>(BlockRanges::kSide);  // a power of two: nothing is rounded
            for (int a = 0; a < 3; ++a) {
                origin[a] = o[a] * kBlock, way[a] = w[a] * kBlock;
                forwards[a] = way[a] >= 0 ? 1 : 0;
                inverse[a] = way[a] == 0 ? 1e300 : 1 / way[a];
            }
        }
        struct Leap {
            bool visible;
            double leave;  ///< end of this state along the ray
        };
        [[nodiscard]] Leap from(double t) const {
            std::int64_t at[3], block = 0;
            for (int a = 2; a >= 0; --a) {
                at[a] = std::clamp(static_cast<std::int64_t>(origin[a] + t * way[a]), std::int64_t{0}, all.count_[a] - 1);
                block = block * all.count_[a] + at[a];
            }
            const std::int64_t distance = all.distance_[block], empty = std::max<std::int64_t>(0, distance - 1);
            double leave = INFINITY;
            for (int a = 0; a < 3; ++a) {
                const std::int64_t edge = forwards[a] != 0 ? at[a] + 1 + empty : at[a] - empty;
                leave = std::min(leave, (static_cast<double>(edge) - origin[a]) * inverse[a]);
            }
            return {distance == 0, leave};
        }
        const EmptySpaceGrid& all;
        Vec3 origin, way;  ///< in blocks
        double inverse[3];
        int forwards[3];
    };

    Index3 count_;
    std::vector<std::uint8_t> distance_;  ///< Chebyshev distance in blocks to the nearest visible one; 0: visible
};

}  // namespace isoatlas
