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

    [[nodiscard]] const Index3& count() const { return count_; }  ///< blocks along each axis
    [[nodiscard]] bool visible(const Index3& block) const { return side_[0][block[0] + count_[0] * (block[1] + count_[1] * block[2])] > 0; }

private:
    /// Exit points of a ray from cubes of blocks, all empty or all visible, that begin at a block and lie in the ray's octant (after
    /// Zuiderveld, Koning, Viergever: Acceleration of ray casting using 3D distance transforms, 1992; theirs lie around the block).
    struct Leaps {
        Leaps(const EmptySpaceGrid& blocks, const Vec3& o, const Vec3& w) : count(blocks.count_) {
            constexpr double kBlock = 1.0 / static_cast<double>(BlockRanges::kSide);  // a power of two: nothing is rounded
            std::size_t octant = 0;
            for (int a = 0; a < 3; ++a) {
                origin[a] = o[a] * kBlock, way[a] = w[a] * kBlock;
                last[a] = static_cast<double>(count[a]) - 0.5;
                exit[a] = way[a] >= 0 ? 1 : 0;
                inverse[a] = way[a] == 0 ? 1e300 : 1 / way[a];
                octant |= (way[a] >= 0 ? 0U : 1U) << a;
            }
            side = blocks.side_[octant].data();
        }
        struct Leap {
            bool visible;
            double leave;  ///< end of this state along the ray
        };
        [[nodiscard]] Leap from(double t) const {
            double leave[3];
            std::int64_t block = 0;
            for (int a = 2; a >= 0; --a) {
                // A place of -1e-9 is cut to 0; one beyond the last block is in it.
                const auto at = static_cast<std::int32_t>(std::min(origin[a] + t * way[a], last[a]));
                leave[a] = (static_cast<double>(at) + exit[a] - origin[a]) * inverse[a];
                block = block * count[a] + at;
            }
            const int cube = side[block];
            const auto more = static_cast<double>(std::abs(cube) - 1);
            for (int a = 0; a < 3; ++a) leave[a] += more * std::abs(inverse[a]);
            return {cube > 0, std::min({leave[0], leave[1], leave[2]})};
        }
        Index3 count;
        const std::int8_t* side;
        Vec3 origin, way;  ///< in blocks
        Vec3 last, exit, inverse;
    };

    Index3 count_;
    /// Of every octant (bit a: down along axis a) and block: side in blocks of the largest cube of visible ones that begins with it, minus
    /// that of empty ones. Nothing ends at the border of the volume.
    std::array<std::vector<std::int8_t>, 8> side_;
};

}  // namespace isoatlas
