#include "render/empty_space.h"

#include <algorithm>
#include <cstring>

#include "base/parallel.h"
#include "base/sample_types.h"
#include "base/target_clones.h"

namespace isoatlas {
namespace {

/// Lowest and highest sample of a row of blocks, along the other two axes.
template <class T>
struct RowExtremes {
    std::vector<T> low, high;
    void begin(std::span<const T> row) { low.assign(row.begin(), row.end()), high = low; }
    void take(std::span<const T> row);
};

template <class T>
ISOATLAS_TARGET_CLONES void RowExtremes<T>::take(std::span<const T> row) {
    constexpr std::size_t kBytes = 32, kCount = kBytes / sizeof(T);
    std::size_t i = 0;
    for (; i + kCount <= row.size(); i += kCount) {
        T __attribute__((vector_size(kBytes))) lows, highs, samples;  // lowered to what the processor has
        std::memcpy(&lows, low.data() + i, sizeof lows), std::memcpy(&highs, high.data() + i, sizeof highs);
        std::memcpy(&samples, row.data() + i, sizeof samples);
        lows = samples < lows ? samples : lows, highs = highs < samples ? samples : highs;
        std::memcpy(low.data() + i, &lows, sizeof lows), std::memcpy(high.data() + i, &highs, sizeof highs);
    }
    for (; i < row.size(); ++i) low[i] = std::min(low[i], row[i]), high[i] = std::max(high[i], row[i]);
}

#define ISOATLAS_INSTANTIATE(T) template struct RowExtremes<T>;
ISOATLAS_FOR_SAMPLE_TYPES(ISOATLAS_INSTANTIATE)
#undef ISOATLAS_INSTANTIATE

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

constexpr std::uint8_t kLargest = 127;

/// Sides of cubes of blocks for which is_inside is 1: one more than the smallest side among the seven neighbours in the octant; 0 where it
/// is 0.
std::vector<std::uint8_t> cubes_of(const std::vector<std::uint8_t>& is_inside, const Index3& count, std::size_t octant) {
    const auto [nx, ny, nz] = count;
    const std::array<bool, 3> down{(octant & 1) != 0, (octant & 2) != 0, (octant & 4) != 0};
    std::vector<std::uint8_t> side(is_inside.size()), least(nx + 2, kLargest);  // least of the three rows before, between two borders
    for (std::int64_t k = 0; k < nz; ++k) {
        for (std::int64_t j = 0; j < ny; ++j) {
            const std::int64_t y = down[1] ? j : ny - 1 - j, z = down[2] ? k : nz - 1 - k;
            const std::int64_t next_y = y + (down[1] ? -1 : 1), next_z = z + (down[2] ? -1 : 1);
            std::fill(least.begin(), least.end(), kLargest);
            const auto take = [&](std::int64_t v, std::int64_t w) {
                if (v < 0 || v >= ny || w < 0 || w >= nz) return;
                const std::uint8_t* row = side.data() + nx * (v + ny * w);
                for (std::int64_t x = 0; x < nx; ++x) least[x + 1] = std::min(least[x + 1], row[x]);
            };
            take(next_y, z), take(y, next_z), take(next_y, next_z);
            std::uint8_t before = kLargest;
            for (std::int64_t i = 0; i < nx; ++i) {
                const std::int64_t x = down[0] ? i : nx - 1 - i, block = x + nx * (y + ny * z);
                const std::uint8_t smallest = std::min({before, least[x + 1], least[down[0] ? x : x + 2]});
                before = static_cast<std::uint8_t>(is_inside[block] * std::min<int>(kLargest, smallest + 1));
                side[block] = before;
            }
        }
    }
    return side;
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

EmptySpaceGrid::EmptySpaceGrid(const BlockRanges& blocks, const Transfer& transfer, int threads) : count_(blocks.count) {
    std::vector<std::uint8_t> visible(blocks.ranges.size()), empty(blocks.ranges.size());
    for_each_index(threads, blocks.ranges.size(), [&](std::size_t i) {
        const auto [low, high] = blocks.ranges[i];
        visible[i] = transfer.visible(low, high) ? 1 : 0, empty[i] = 1 - visible[i];
    });
    for_each_block(threads, static_cast<std::int64_t>(side_.size()), [&](std::int64_t octant) {
        const std::vector<std::uint8_t> of_visible = cubes_of(visible, count_, octant), of_empty = cubes_of(empty, count_, octant);
        side_[octant].resize(visible.size());
        for (std::size_t i = 0; i < visible.size(); ++i) side_[octant][i] = static_cast<std::int8_t>(of_visible[i] - of_empty[i]);
    });
}

}  // namespace isoatlas
