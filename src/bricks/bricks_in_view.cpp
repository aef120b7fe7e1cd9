#include "bricks/bricks_in_view.h"

#include <algorithm>

#include "bricks/brick_classes.h"

namespace isoatlas {
namespace {

/// Value range of the cells of a brick: cells at its end have corners in the next bricks.
std::array<double, 2> range_of_cells(const BrickGrid& grid, BrickId brick, IdSpan<BrickId, const std::array<double, 2>> ranges) {
    const Index3 first = grid.place(brick);
    std::array<double, 2> all = ranges[brick];
    for (int corner = 1; corner < 8; ++corner) {
        const Index3 place = min(first + Index3{corner & 1, corner >> 1 & 1, corner >> 2}, grid.size - 1);
        const auto& [low, high] = ranges[grid.brick(place)];
        all = {std::min(all[0], low), std::max(all[1], high)};
    }
    return all;
}

void flag_box(const BrickGrid& grid, const SampleBox& box, BrickFlags& flags) {
    Index3 begin{}, end{};
    for (int a = 0; a < 3; ++a) {
        begin[a] = std::max<std::int64_t>(0, box.begin[a]) / kBrickSize[a];
        end[a] = std::min(grid.size[a], (box.end[a] + kBrickSize[a] - 1) / kBrickSize[a]);
    }
    for (std::int64_t z = begin[2]; z < end[2]; ++z) {
        for (std::int64_t y = begin[1]; y < end[1]; ++y) {
            for (std::int64_t x = begin[0]; x < end[0]; ++x) flags[grid.brick({x, y, z})] = 1;
        }
    }
}

}  // namespace

BrickFlags bricks_in_view(const BrickGrid& grid, const SamplesWanted& wanted, const std::function<std::array<double, 2>(BrickId)>& range) {
    BrickFlags flags(static_cast<std::size_t>(grid.count()), 0);
    if (!wanted.values.empty()) {
        IdArray<BrickId, std::array<double, 2>> ranges(flags.size());
        for (const BrickId b : grid.bricks()) ranges[b] = range(b);
        for (const BrickId b : grid.bricks()) {
            const std::array<double, 2> cells = range_of_cells(grid, b, ranges);
            flags[b] = std::any_of(wanted.values.begin(), wanted.values.end(),
                                   [&](const std::array<double, 2>& values) { return cells[1] >= values[0] && cells[0] <= values[1]; });
        }
        // Samples near a cell lie in the adjacent bricks: bricks with a successor are full.
        flags = with_halo(grid, std::move(flags));
    }
    for (const SampleBox& box : wanted.boxes) flag_box(grid, box, flags);
    return flags;
}

}  // namespace isoatlas
