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

/// Are the bricks at and beside a place along x all of one class? Outside of the grid everything is Low.
bool is_row_of(BrickClass own, const BrickGrid& grid, const std::vector<BrickClass>& classes, const std::array<std::int64_t, 3>& place) {
    const bool outside = place[1] < 0 || place[2] < 0 || place[1] >= grid.size[1] || place[2] >= grid.size[2];
    for (std::int64_t x = place[0] - 1; x <= place[0] + 1; ++x) {
        const bool is_outside = outside || x < 0 || x >= grid.size[0];
        if ((is_outside ? BrickClass::low : classes[static_cast<std::size_t>(grid.brick({x, place[1], place[2]}))]) != own) return false;
    }
    return true;
}

/// Rows of samples [begin, end) of an axis that belong to a side of a box: before it, in it, behind it.
std::array<std::int64_t, 2> side_of(const Box& box, int axis, std::int64_t side) {
    if (side < 0) return {box.begin[axis] - kSurroundings, box.begin[axis]};
    return side == 0 ? std::array{box.begin[axis], box.end[axis]} : std::array{box.end[axis], box.end[axis] + kSurroundings};
}

bool is_uniform_around(const BrickGrid& grid, const HighBits& high, const std::vector<BrickClass>& classes, std::int64_t brick) {
    const BrickClass own = classes[static_cast<std::size_t>(brick)];
    const std::array<std::int64_t, 3> place = grid.place(brick);
    const Box box = grid.box(brick);
    const std::int64_t flat = grid.extent.rank == 2 ? 0 : 1;
    const auto is_uniform = [&](std::int64_t y, std::int64_t z) {
        const RowPart part = surroundings(box, y, z);  // position p is voxel p - 1
        const std::int64_t begin = std::max<std::int64_t>(part.begin + 1, 0), end = std::min(part.end + 1, grid.extent.size[0] + 2);
        return begin >= end || all_equal(high.row(y, z), begin, end, own == BrickClass::high);  // rows outside are Low
    };
    for (std::int64_t side_z = -flat; side_z <= flat; ++side_z) {
        for (std::int64_t side_y = -1; side_y <= 1; ++side_y) {
            if (is_row_of(own, grid, classes, {place[0], place[1] + side_y, place[2] + side_z})) continue;
            const auto ys = side_of(box, 1, side_y), zs = side_of(box, 2, side_z);
            for (std::int64_t z = zs[0]; z < zs[1]; ++z) {
                for (std::int64_t y = ys[0]; y < ys[1]; ++y) {
                    if (!is_uniform(y, z)) return false;
                }
            }
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

bool is_beside_surface(const HighBits& high, const BrickGrid& grid, const std::vector<BrickClass>& classes, std::int64_t brick) {
    return !is_uniform_around(grid, high, classes, brick);
}

std::vector<std::int64_t> beside_surface(const HighBits& high, const BrickGrid& grid, const std::vector<BrickClass>& classes, int threads) {
    std::vector<std::uint8_t> wanted = touching_others(grid, classes);
    for_bricks(grid, threads, [&](std::int64_t b) {
        const auto i = static_cast<std::size_t>(b);
        if (wanted[i]) wanted[i] = is_beside_surface(high, grid, classes, b);
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
