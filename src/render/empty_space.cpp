#include "render/empty_space.h"

#include <algorithm>

#include "base/parallel.h"

namespace isoatlas {
namespace {

/// Lowest and highest sample of a row of blocks, along the other two axes.
template <class T>
struct RowExtremes {
    std::vector<T> low, high;
    void begin(std::span<const T> row) { low.assign(row.begin(), row.end()), high = low; }
    void take(std::span<const T> row) {
        T* lows = low.data();
        T* highs = high.data();
        const T* samples = row.data();
        for (std::size_t i = 0; i < row.size(); ++i) lows[i] = std::min(lows[i], samples[i]), highs[i] = std::max(highs[i], samples[i]);
    }
};

template <class T>
void find_row(std::span<const T> samples, const Extent& extent, std::int64_t row, BlockRanges& blocks) {
    constexpr std::int64_t kSide = BlockRanges::kSide;
    const std::int64_t y = row % blocks.count[1] * kSide, z = row / blocks.count[1] * kSide;
    RowExtremes<T> extremes;
    extremes.begin(samples.subspan(extent.index(0, y, z), extent.size[0]));
    for (std::int64_t w = z; w <= std::min(extent.size[2] - 1, z + kSide); ++w) {
        for (std::int64_t v = y; v <= std::min(extent.size[1] - 1, y + kSide); ++v)
            extremes.take(samples.subspan(extent.index(0, v, w), extent.size[0]));
    }
    for (std::int64_t x = 0; x < blocks.count[0]; ++x) {
        const std::int64_t first = x * kSide, last = std::min(extent.size[0] - 1, first + kSide);
        T low = extremes.low[first], high = extremes.high[first];
        for (std::int64_t u = first + 1; u <= last; ++u) low = std::min(low, extremes.low[u]), high = std::max(high, extremes.high[u]);
        blocks.ranges[row * blocks.count[0] + x] = {static_cast<double>(low), static_cast<double>(high)};
    }
}

constexpr int kFurthest = 255;

/// One sweep of a distance transform: the distance of a block is at most one more than those of its preceding 26-neighbours.
/// step: 1 from the first block to the last, -1 back.
void sweep(std::vector<std::uint8_t>& distance, const Index3& count, std::int64_t step) {
    const auto [nx, ny, nz] = count;
    std::vector<std::uint8_t> before(nx + 2, kFurthest);  // nearest in the four rows before, between two borders
    const auto row_at = [&](std::int64_t y, std::int64_t z) { return distance.data() + nx * (y + ny * z); };
    for (std::int64_t k = 0; k < nz; ++k) {
        for (std::int64_t j = 0; j < ny; ++j) {
            const std::int64_t y = step > 0 ? j : ny - 1 - j, z = step > 0 ? k : nz - 1 - k;
            std::fill(before.begin(), before.end(), std::uint8_t{kFurthest});
            const auto take = [&](std::int64_t v, std::int64_t w) {
                if (v < 0 || v >= ny || w < 0 || w >= nz) return;
                const std::uint8_t* row = row_at(v, w);
                for (std::int64_t x = 0; x < nx; ++x) before[x + 1] = std::min(before[x + 1], row[x]);
            };
            take(y - step, z), take(y - 1, z - step), take(y, z - step), take(y + 1, z - step);
            std::uint8_t* row = row_at(y, z);
            int last = kFurthest;
            for (std::int64_t i = 0; i < nx; ++i) {
                const std::int64_t x = step > 0 ? i : nx - 1 - i;
                const int nearest = std::min<int>({last, before[x], before[x + 1], before[x + 2]});
                last = std::min<int>(row[x], std::min(kFurthest, nearest + 1));
                row[x] = static_cast<std::uint8_t>(last);
            }
        }
    }
}

}  // namespace

std::array<double, 2> BlockRanges::whole() const {
    std::array<double, 2> range = ranges[0];
    for (const auto& [low, high] : ranges) range = {std::min(range[0], low), std::max(range[1], high)};
    return range;
}

BlockRanges block_ranges(const Volume& volume, int threads) {
    const Extent& extent = volume.info.extent;
    BlockRanges blocks;
    for (int a = 0; a < 3; ++a) blocks.count[a] = std::max<std::int64_t>(1, (extent.size[a] - 2 + BlockRanges::kSide) / BlockRanges::kSide);
    blocks.ranges.resize(blocks.count.product());
    visit_samples(volume, [&](auto samples) {
        for_each_block(threads, blocks.count[1] * blocks.count[2], [&](std::int64_t row) { find_row(samples, extent, row, blocks); });
    });
    return blocks;
}

EmptySpaceGrid::EmptySpaceGrid(const BlockRanges& blocks, const Transfer& transfer, int threads)
    : count_(blocks.count), distance_(blocks.ranges.size()) {
    for_each_index(threads, distance_.size(), [&](std::size_t i) {
        const auto [low, high] = blocks.ranges[i];
        distance_[i] = transfer.visible(low, high) ? 0 : kFurthest;
    });
    sweep(distance_, count_, 1);
    sweep(distance_, count_, -1);
}

}  // namespace isoatlas
