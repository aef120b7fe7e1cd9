#include "bricks/region_growing.h"

#include <algorithm>
#include <utility>

#include "bricks/brick_classes.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kAround = kBrickSize[1] + 2;  ///< rows along an axis of BrickBitsAround

std::size_t row_of(std::int64_t y, std::int64_t z) { return static_cast<std::size_t>(y + kBrickSize[1] * z); }
std::size_t row_around(std::int64_t y, std::int64_t z) { return static_cast<std::size_t>(y + 1 + kAround * (z + 1)); }

/// The samples that `around` has in the neighbour of its brick in direction d.
BrickBits in_neighbour(const BrickBitsAround& around, const Index3& d) {
    BrickBits bits{};
    const auto rows = [](std::int64_t step) {  // of the neighbour
        return step == 0 ? std::array<std::int64_t, 2>{0, kBrickSize[1]}
                         : std::array<std::int64_t, 2>{step < 0 ? kBrickSize[1] - 1 : 0, step < 0 ? kBrickSize[1] : 1};
    };
    const auto ys = rows(d[1]), zs = rows(d[2]);
    for (std::int64_t z = zs[0]; z < zs[1]; ++z) {
        for (std::int64_t y = ys[0]; y < ys[1]; ++y) {
            const std::uint32_t row = around[row_around(y + d[1] * kBrickSize[1], z + d[2] * kBrickSize[2])];
            const std::uint32_t own = d[0] == 0 ? row >> 1 : d[0] < 0 ? (row & 1) << (kBrickRow - 1) : row >> (kBrickRow + 1);
            bits[row_of(y, z)] = static_cast<std::uint16_t>(own);
        }
    }
    return bits;
}

bool is_empty(const BrickBits& bits) {
    return std::ranges::all_of(bits, [](std::uint16_t row) { return row == 0; });
}

/// The Highs that chains within the brick join with `reached`.
BrickBits grown_within(const BrickBits& high, BrickBits reached) {
    for (;;) {
        const BrickBitsAround around = with_neighbours(reached);
        BrickBits next = in_neighbour(around, {0, 0, 0});
        for (std::size_t row = 0; row < next.size(); ++row) next[row] &= high[row];
        if (next == reached) return reached;
        reached = next;
    }
}

}  // namespace

BrickBitsAround with_neighbours(const BrickBits& bits) {
    BrickBitsAround along_y{}, around{};
    for (std::int64_t z = 0; z < kBrickSize[2]; ++z) {
        for (std::int64_t y = 0; y < kBrickSize[1]; ++y) {
            const std::uint32_t row = bits[row_of(y, z)], along_x = row | row << 1 | row << 2;
            for (std::int64_t step = -1; step <= 1; ++step) along_y[row_around(y + step, z)] |= along_x;
        }
    }
    for (std::int64_t z = 0; z < kBrickSize[2]; ++z) {
        for (std::int64_t y = -1; y <= kBrickSize[1]; ++y) {
            for (std::int64_t step = -1; step <= 1; ++step) around[row_around(y, z + step)] |= along_y[row_around(y, z)];
        }
    }
    return around;
}

RegionGrowing::RegionGrowing(const BrickGrid& grid, IdSpan<BrickId, const BrickClass> classes)
    : grid_(grid), classes_(classes), touched_(classes.size(), 0), number_(classes.size(), -1) {}

RegionGrowing::Brick& RegionGrowing::brick_of(BrickId id) {
    if (number_[id] < 0) {
        number_[id] = std::ssize(bricks_);
        Brick& brick = bricks_.emplace_back();
        brick.id = id;
        if (classes_[id] == BrickClass::high) brick.is_known = true, brick.high = whole_brick(grid_.box(id).size());
    }
    return bricks_[static_cast<std::size_t>(number_[id])];
}

void RegionGrowing::seed(const Index3& voxel) {
    const Index3 place = BrickGrid::place_of(voxel);
    const BrickId id = grid_.brick(place);
    const Index3 at = voxel - grid_.box(id).begin;
    BrickBits bits{};
    bits[row_of(at[1], at[2])] = static_cast<std::uint16_t>(1 << at[0]);
    reach(id, bits);
}

void RegionGrowing::reach(BrickId id, const BrickBits& samples) {
    if (classes_[id] == BrickClass::low) return;
    Brick& brick = brick_of(id);
    touched_[id] = 1;
    if (brick.is_known) {
        reach_known(brick, samples);
        return;
    }
    if (is_empty(brick.reached)) missing_.push_back(id);
    for (std::size_t row = 0; row < samples.size(); ++row) brick.reached[row] |= samples[row];
}

void RegionGrowing::reach_known(Brick& brick, const BrickBits& samples) {
    std::uint16_t added = 0;
    for (std::size_t row = 0; row < samples.size(); ++row) {
        const auto more = static_cast<std::uint16_t>(samples[row] & brick.high[row] & ~brick.reached[row]);
        brick.reached[row] |= more;
        added |= more;
    }
    if (added == 0 || brick.is_pending) return;
    brick.is_pending = true;
    pending_.push_back(number_[brick.id]);
}

void RegionGrowing::spread(const Brick& from) {
    const BrickBitsAround around = with_neighbours(from.reached);
    const Index3 place = grid_.place(from.id);
    for_neighbours(grid_, from.id, [&](BrickId neighbour) {
        if (classes_[neighbour] == BrickClass::low) return;
        const BrickBits samples = in_neighbour(around, grid_.place(neighbour) - place);
        if (!is_empty(samples)) reach(neighbour, samples);
    });
}

std::vector<BrickId> RegionGrowing::grow() {
    while (!pending_.empty()) {
        Brick& brick = bricks_[static_cast<std::size_t>(pending_.back())];
        pending_.pop_back();
        brick.is_pending = false;
        brick.reached = grown_within(brick.high, brick.reached);
        spread(Brick(brick));  // a copy: bricks are added
    }
    std::vector<BrickId> missing = std::exchange(missing_, {});
    std::ranges::sort(missing);
    return missing;
}

void RegionGrowing::extend(std::vector<BrickId>& missing, std::int64_t count) const {
    BrickFlags taken(classes_.size(), 0);
    for (const BrickId id : missing) taken[id] = 1;
    for (std::size_t next = 0; next < missing.size() && std::ssize(missing) < count; ++next) {
        for_neighbours(grid_, missing[next], [&](BrickId id) {
            const bool is_known = number_[id] >= 0 && bricks_[static_cast<std::size_t>(number_[id])].is_known;
            if (taken[id] || is_known || classes_[id] != BrickClass::divided) return;
            taken[id] = 1;
            missing.push_back(id);
        });
    }
    std::ranges::sort(missing);
}

void RegionGrowing::add(BrickId id, const BrickBits& high) {
    Brick& brick = brick_of(id);
    const BrickBits samples = std::exchange(brick.reached, {});
    brick.is_known = true;
    brick.high = high;
    reach_known(brick, samples);
}

}  // namespace isoatlas
