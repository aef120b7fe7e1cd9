// The cells of a volume: boxes between 8 neighbouring samples (4 in 2D). Those around the volume, towards the outside, are not among them.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "field/order.h"
#include "isoatlas/volume.h"

namespace isoatlas {

[[nodiscard]] inline std::int64_t cell_count(const Extent& extent) {
    const std::int64_t flat = (extent.size[0] - 1) * (extent.size[1] - 1);
    return extent.rank == 2 ? flat : flat * (extent.size[2] - 1);
}

/// Calls visit(voxels at the corners) for every cell whose first corner lies in slice z.
template <class Visit>
void for_cells_of_slice(const Extent& extent, std::int64_t z, const Visit& visit) {
    if (extent.rank == 3 && z + 1 >= extent.size[2]) return;
    const GridSteps steps(extent);
    std::array<std::int64_t, 8> corners{};
    const std::span<const std::int64_t> used = std::span(corners).first(extent.rank == 2 ? 4 : 8);
    for (std::int64_t y = 0; y + 1 < extent.size[1]; ++y) {
        for (std::int64_t x = 0; x + 1 < extent.size[0]; ++x) {
            for (std::size_t k = 0; k < used.size(); ++k) corners[k] = steps.cell_corner(extent.index(x, y, z), static_cast<int>(k));
            visit(used);
        }
    }
}

}  // namespace isoatlas
