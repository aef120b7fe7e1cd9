#include "measures/voxel_boxes.h"

namespace isoatlas {

VoxelBoxes::VoxelBoxes(const Geometry& geometry, const Extent& extent)
    : origin(geometry.origin), direction(geometry.direction), skew(skew_of(geometry, extent.rank)) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto count = static_cast<std::size_t>(extent.size[axis]);
        const std::vector<double>& c = geometry.coordinates[axis];
        middle[axis].resize(count);
        width[axis].assign(count, axis == 2 && extent.rank == 2 ? 0 : geometry.spacing[axis]);
        for (std::size_t i = 0; i < count; ++i) {
            if (c.size() < 2) {
                middle[axis][i] = (c.empty() ? 0 : c[0]) + geometry.spacing[axis] * static_cast<double>(i);
                continue;
            }
            const double before = i > 0 ? c[i] - c[i - 1] : c[1] - c[0];
            const double after = i + 1 < count ? c[i + 1] - c[i] : c[i] - c[i - 1];
            middle[axis][i] = c[i] + (after - before) / 4;
            width[axis][i] = (before + after) / 2;
        }
    }
}

}  // namespace isoatlas
