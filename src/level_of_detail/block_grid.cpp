#include "level_of_detail/block_grid.h"

#include <algorithm>

namespace isoatlas {

BlockGrid::BlockGrid(const BoundingBox& box, double edge, double shift) : low_(box.low), edge_(edge) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        low_[axis] -= shift;
        count_[axis] = std::isinf(edge) ? 1 : static_cast<std::int64_t>(std::floor((box.high[axis] - low_[axis]) / edge)) + 1;
    }
}

std::vector<SurfaceBlock> blocks_of(SurfaceState& state, const BlockGrid& grid) {
    std::vector<SurfaceBlock> blocks(static_cast<std::size_t>(grid.blocks()));
    std::ranges::fill(state.locked, std::uint8_t{0});
    for (std::uint32_t t = 0; t < state.mesh.triangles(); ++t) {
        if (!state.mesh.has_triangle(t)) continue;
        const std::array<std::uint32_t, 3> corners = state.mesh.triangle(t);
        BlockGrid::Place first = grid.of(state.scaled[corners[0]]), last = first;
        for (const std::uint32_t point : corners) {
            const BlockGrid::Place place = grid.of(state.scaled[point]);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                first[axis] = std::min(first[axis], place[axis]), last[axis] = std::max(last[axis], place[axis]);
            }
        }
        if (first == last) {
            SurfaceBlock& block = blocks[grid.number(first)];
            block.grid = &grid, block.place = first;
            block.inside.push_back(t);
            continue;
        }
        for (const std::uint32_t point : corners) state.locked[point] = 1;
        for (std::int64_t z = first[2]; z <= last[2]; ++z) {
            for (std::int64_t y = first[1]; y <= last[1]; ++y) {
                for (std::int64_t x = first[0]; x <= last[0]; ++x) blocks[grid.number({x, y, z})].crossing.push_back(t);
            }
        }
    }
    std::erase_if(blocks, [](const SurfaceBlock& block) { return block.inside.empty(); });
    return blocks;
}

}  // namespace isoatlas
