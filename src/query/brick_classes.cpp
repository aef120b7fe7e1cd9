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

bool may_touch(const BrickGrid& grid, std::int64_t brick, const std::vector<BrickClass>& classes) {
    const BrickClass own = classes[static_cast<std::size_t>(brick)];
    const std::array<std::int64_t, 3> at = grid.place(brick);
    const std::int64_t flat = grid.extent.rank == 2 ? 0 : 1;
    for (std::int64_t z = at[2] - flat; z <= at[2] + flat; ++z) {
        for (std::int64_t y = at[1] - 1; y <= at[1] + 1; ++y) {
            for (std::int64_t x = at[0] - 1; x <= at[0] + 1; ++x) {
                const bool inside = x >= 0 && y >= 0 && z >= 0 && x < grid.size[0] && y < grid.size[1] && z < grid.size[2];
                const BrickClass other = inside ? classes[static_cast<std::size_t>(grid.brick({x, y, z}))] : BrickClass::low;
                if (other != own) return true;
            }
        }
    }
    return false;
}

bool is_beside_surface(const HighBits& high, const BrickGrid& grid, std::int64_t brick, const std::vector<BrickClass>& classes) {
    const BrickClass own = classes[static_cast<std::size_t>(brick)];
    if (own == BrickClass::divided || !may_touch(grid, brick, classes)) return false;
    return !is_uniform_around(grid, high, brick, own == BrickClass::high);
}

std::vector<std::int64_t> beside_surface(const HighBits& high, const BrickGrid& grid, const std::vector<BrickClass>& classes, int threads) {
    std::vector<std::uint8_t> wanted(classes.size());
    for_bricks(grid, threads, [&](std::int64_t b) { wanted[static_cast<std::size_t>(b)] = is_beside_surface(high, grid, b, classes); });
    return flagged(wanted);
}

std::vector<std::uint8_t> with_neighbours(const BrickGrid& grid, std::vector<std::uint8_t> flags) {
    std::int64_t stride = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::vector<std::uint8_t> before = flags;
        for (std::int64_t b = 0; b < grid.count(); ++b) {
            const std::int64_t at = grid.place(b)[axis];
            if (at > 0) flags[static_cast<std::size_t>(b)] |= before[static_cast<std::size_t>(b - stride)];
            if (at + 1 < grid.size[axis]) flags[static_cast<std::size_t>(b)] |= before[static_cast<std::size_t>(b + stride)];
        }
        stride *= grid.size[axis];
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
