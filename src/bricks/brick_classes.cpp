#include "bricks/brick_classes.h"

#include <algorithm>

#include "base/parallel.h"
#include "bricks/brick_surroundings.h"

namespace isoatlas {

namespace {

/// Are the bits [begin, end) of a row all equal to `high`? At most 64 of them.
bool all_equal(const std::uint64_t* row, std::int64_t begin, std::int64_t end, bool high) {
    const std::int64_t w = begin / 64, skip = begin % 64;
    const std::uint64_t bits = skip == 0 ? row[w] : row[w] >> skip | row[w + 1] << (64 - skip);
    const std::uint64_t mask = ~std::uint64_t{0} >> (64 - (end - begin));
    return (bits & mask) == (high ? mask : 0);
}

/// Range of samples of a box that are adjacent to another box in direction d along an axis: the first layer, all, the last layer.
std::array<std::int64_t, 2> facing(const Box& box, int axis, std::int64_t d) {
    if (d < 0) return {box.begin[axis] - 1, box.begin[axis]};
    return d == 0 ? std::array{box.begin[axis], box.end[axis]} : std::array{box.end[axis], box.end[axis] + 1};
}

/// Has a divided brick, which touches another one along an edge or at a corner, samples of the other class in a cell shared with that
/// brick?
bool meets_in_cell(const HighBits& high, const Box& box, bool own, const Index3& d) {
    const auto xs = facing(box, 0, d[0]), ys = facing(box, 1, d[1]), zs = facing(box, 2, d[2]);
    for (std::int64_t z = zs[0]; z < zs[1]; ++z) {
        for (std::int64_t y = ys[0]; y < ys[1]; ++y) {
            if (!all_equal(high.row(y, z), xs[0] + 1, xs[1] + 1, own)) return true;  // position p is voxel p - 1
        }
    }
    return false;
}

/// Towards the 26 neighbours of a brick, first those that share a face with it: most often one of them has an answer.
constexpr std::array<Index3, 26> kDirections = [] {
    std::array<Index3, 26> directions{};
    std::size_t count = 0;
    for (int axes = 1; axes <= 3; ++axes) {
        for (std::int64_t i = 0; i < 27; ++i) {
            const Index3 d{i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1};
            if ((d[0] != 0) + (d[1] != 0) + (d[2] != 0) == axes) directions[count++] = d;
        }
    }
    return directions;
}();

/// Layers of a brick, as bits, within `steps` of its neighbour in direction -d.
std::uint16_t near_layers(std::size_t axis, std::int64_t d, int steps) {
    const int first = (1 << steps) - 1;
    return static_cast<std::uint16_t>(d > 0 ? first : first << (kBrickSize[axis] - steps));
}

}  // namespace

BrickFlags touching_others(const BrickGrid& grid, IdSpan<BrickId, const BrickClass> classes) {
    constexpr std::uint8_t kLow = 1, kHigh = 2;
    BrickFlags has(classes.size());
    for (const BrickId b : classes.ids())
        has[b] = classes[b] == BrickClass::divided ? kLow | kHigh : classes[b] == BrickClass::high ? kHigh : kLow;
    BrickFlags touching = with_halo(grid, has, kLow);
    for (const BrickId b : touching.ids()) touching[b] = classes[b] != BrickClass::divided && touching[b] != has[b];
    return touching;
}

bool touches_surface(const HighBits& high, const LevelBricks& bricks, IdSpan<BrickId, const BrickFaces> sides, BrickId brick) {
    const BrickGrid& grid = bricks.grid;
    const BrickClass own = bricks.classes[brick];
    const Index3 place = grid.place(brick);
    const Box box = grid.box(brick);
    const auto is_at_border = [&](std::size_t axis) { return place[axis] == 0 || place[axis] + 1 == grid.size[axis]; };
    const bool has_outside = is_at_border(0) || is_at_border(1) || is_at_border(2);
    const auto is_beside = [&](const Index3& d) {
        for (std::size_t axis = 0; has_outside && axis < 3; ++axis) {
            if (place[axis] + d[axis] < 0 || place[axis] + d[axis] >= grid.size[axis]) return own == BrickClass::high;  // outside is Low
        }
        const BrickId other(brick.number() + grid.brick(d).number());
        if (bricks.classes[other] != BrickClass::divided) return bricks.classes[other] != own;
        const int axes = (d[0] != 0) + (d[1] != 0) + (d[2] != 0);
        const auto& layers = own == BrickClass::high ? sides[other].low : sides[other].high;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const int steps = axes == 1 ? static_cast<int>(kSurroundings) : 1;
            if (d[axis] != 0 && (layers[axis] & near_layers(axis, d[axis], steps)) == 0) return false;
        }
        return axes == 1 || meets_in_cell(high, box, own == BrickClass::high, d);
    };
    const bool is_flat = grid.extent.rank == 2;
    return std::ranges::any_of(kDirections, [&](const Index3& d) { return !(is_flat && d[2] != 0) && is_beside(d); });
}

std::vector<BrickId> beside_surface(const HighBits& high, const LevelBricks& bricks, IdSpan<BrickId, const BrickFaces> sides, int threads) {
    BrickFlags wanted = touching_others(bricks.grid, bricks.classes);
    for_bricks(bricks.grid, threads, [&](BrickId b) {
        if (wanted[b]) wanted[b] = touches_surface(high, bricks, sides, b);
    });
    return flagged(wanted);
}

BrickFlags with_halo(const BrickGrid& grid, BrickFlags of_bricks, std::uint8_t outside) {
    BigVector<std::uint8_t>& flags = of_bricks.items();
    const std::size_t axes = grid.extent.rank == 2 ? 2 : 3;
    std::size_t stride = 1;
    for (std::size_t axis = 0; axis < axes; ++axis) {
        const BigVector<std::uint8_t> before = flags;
        const auto size = static_cast<std::size_t>(grid.size[axis]), line = stride * size;
        for (std::size_t first = 0; first < flags.size(); first += line) {
            const auto add = [&](std::size_t i, std::size_t from) { flags[first + i] |= before[first + from]; };
            for (std::size_t i = 0; i < stride; ++i) flags[first + i] |= outside, flags[first + line - stride + i] |= outside;
            for (std::size_t i = stride; i < line; ++i) add(i, i - stride);
            for (std::size_t i = 0; i + stride < line; ++i) add(i, i + stride);
        }
        stride = line;
    }
    return of_bricks;
}

BrickFlags joined_bricks(const BrickGrid& grid, const std::vector<BrickId>& homes, IdSpan<BrickId, const BrickClass> classes) {
    BrickFlags joined(classes.size(), 0);
    std::vector<BrickId> pending;
    const auto join = [&](BrickId brick) {
        if (joined[brick] || classes[brick] == BrickClass::low) return;
        joined[brick] = 1;
        pending.push_back(brick);
    };
    for (const BrickId home : homes) join(home);
    while (!pending.empty()) {
        const BrickId brick = pending.back();
        pending.pop_back();
        for_neighbours(grid, brick, join);
    }
    return joined;
}

void make_others_low(const BrickPart& part, const BrickFlags& kept, IdArray<BrickId, BrickClass>& classes) {
    for (const BrickId b : classes.ids()) {
        if (!kept[part.number(b)]) classes[b] = BrickClass::low;
    }
}

std::vector<BrickId> divided_bricks(const BrickPart& part, const LevelBricks& bricks) {
    std::vector<BrickId> divided;
    for (const BrickId b : part.grid.bricks()) {
        if (bricks.classes[b] == BrickClass::divided) divided.push_back(part.number(b));
    }
    return divided;
}

std::vector<BrickId> flagged(IdSpan<BrickId, const std::uint8_t> flags) {
    std::vector<BrickId> list;
    for (const BrickId b : flags.ids()) {
        if (flags[b]) list.push_back(b);
    }
    return list;
}

void for_bricks(const BrickGrid& grid, int threads, const std::function<void(BrickId)>& visit) {
    for_each_block(threads, grid.size[2], [&](std::int64_t z) {
        for (const BrickId b : grid.bricks_of_layer(z)) visit(b);
    });
}

}  // namespace isoatlas
