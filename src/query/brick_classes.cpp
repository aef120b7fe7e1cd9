#include "query/brick_classes.h"

#include <algorithm>

#include "base/parallel.h"
#include "query/brick_surroundings.h"

namespace isoatlas {

using store::Box;
using store::BrickGrid;

namespace {

/// Are the bits [begin, end) of a row all equal to `high`? At most 64 of them.
bool all_equal(const std::uint64_t* row, std::int64_t begin, std::int64_t end, bool high) {
    const std::int64_t w = begin / 64, skip = begin % 64;
    const std::uint64_t bits = skip == 0 ? row[w] : row[w] >> skip | row[w + 1] << (64 - skip);
    const std::uint64_t mask = ~std::uint64_t{0} >> (64 - (end - begin));
    return (bits & mask) == (high ? mask : 0);
}

bool is_uniform_around(const BrickGrid& grid, const HighBits& high, std::int64_t brick, bool own) {
    const Box box = grid.box(brick);
    const std::int64_t flat = grid.extent.rank == 2 ? 0 : kSurroundings;
    for (std::int64_t z = box.begin[2] - flat; z < box.end[2] + flat; ++z) {
        for (std::int64_t y = box.begin[1] - kSurroundings; y < box.end[1] + kSurroundings; ++y) {
            const RowPart part = surroundings(box, y, z);  // position p is voxel p - 1
            const std::int64_t begin = std::max<std::int64_t>(part.begin + 1, 0), end = std::min(part.end + 1, grid.extent.size[0] + 2);
            if (begin < end && !all_equal(high.row(y, z), begin, end, own)) return false;  // rows outside are Low
        }
    }
    return true;
}

}  // namespace

std::vector<std::uint8_t> touching_others(const BrickGrid& grid, const std::vector<BrickClass>& classes) {
    constexpr std::uint8_t kLow = 1, kHigh = 2;
    std::vector<std::uint8_t> has(classes.size());
    std::transform(classes.begin(), classes.end(), has.begin(), [](BrickClass own) {
        return own == BrickClass::divided ? kLow | kHigh : own == BrickClass::high ? kHigh : kLow;
    });
    std::vector<std::uint8_t> touching = with_neighbours(grid, has, kLow);
    for (std::size_t b = 0; b < touching.size(); ++b) touching[b] = classes[b] != BrickClass::divided && touching[b] != has[b];
    return touching;
}

bool is_beside_surface(const HighBits& high, const BrickGrid& grid, std::int64_t brick, BrickClass own) {
    return !is_uniform_around(grid, high, brick, own == BrickClass::high);
}

std::vector<std::int64_t> beside_surface(const HighBits& high, const BrickGrid& grid, const std::vector<BrickClass>& classes, int threads) {
    std::vector<std::uint8_t> wanted = touching_others(grid, classes);
    for_bricks(grid, threads, [&](std::int64_t b) {
        const auto i = static_cast<std::size_t>(b);
        if (wanted[i]) wanted[i] = is_beside_surface(high, grid, b, classes[i]);
    });
    return flagged(wanted);
}

std::vector<std::uint8_t> with_neighbours(const BrickGrid& grid, std::vector<std::uint8_t> flags, std::uint8_t outside) {
    const std::size_t axes = grid.extent.rank == 2 ? 2 : 3;
    std::size_t stride = 1;
    for (std::size_t axis = 0; axis < axes; ++axis) {
        const std::vector<std::uint8_t> before = flags;
        const auto size = static_cast<std::size_t>(grid.size[axis]), line = stride * size;
        for (std::size_t first = 0; first < flags.size(); first += line) {
            const auto add = [&](std::size_t i, std::size_t from) { flags[first + i] |= before[first + from]; };
            for (std::size_t i = 0; i < stride; ++i) flags[first + i] |= outside, flags[first + line - stride + i] |= outside;
            for (std::size_t i = stride; i < line; ++i) add(i, i - stride);
            for (std::size_t i = 0; i + stride < line; ++i) add(i, i + stride);
        }
        stride = line;
    }
    return flags;
}

std::vector<std::int64_t> flagged(const std::vector<std::uint8_t>& flags) {
    std::vector<std::int64_t> list;
    for (std::size_t b = 0; b < flags.size(); ++b) {
        if (flags[b]) list.push_back(static_cast<std::int64_t>(b));
    }
    return list;
}

void for_bricks(const BrickGrid& grid, int threads, const std::function<void(std::int64_t)>& visit) {
    const std::int64_t layer = grid.size[0] * grid.size[1];
    for_each_block(threads, grid.size[2], [&](std::int64_t z) {
        for (std::int64_t b = z * layer; b < (z + 1) * layer; ++b) visit(b);
    });
}

}  // namespace isoatlas
