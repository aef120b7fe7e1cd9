#include <algorithm>
#include <array>

#include "formats/common/volume_file.h"

namespace isoatlas {

bool is_rectilinear(const Geometry& geometry) {
    return std::any_of(geometry.coordinates.begin(), geometry.coordinates.end(), [](const auto& axis) { return !axis.empty(); });
}

Geometry regular_geometry(const VolumeInfo& info) {
    Geometry geometry = info.geometry;
    geometry.origin = to_physical(info.geometry, {0, 0, 0});
    for (int axis = 0; axis < 3; ++axis) {
        const std::vector<double>& c = info.geometry.coordinates[axis];
        if (c.size() > 1) geometry.spacing[axis] = (c.back() - c.front()) / static_cast<double>(c.size() - 1);
        geometry.coordinates[axis].clear();
    }
    return geometry;
}

bool is_anatomical(const std::string& space) { return space == "LPS" || space == "RAS" || space == "LAS"; }

Geometry turned_to(Geometry geometry, const std::string& space) {
    if (!is_anatomical(geometry)) return geometry;
    for (std::size_t row = 0; row < 3; ++row) {
        if (geometry.space[row] == space[row]) continue;
        // 0 - x keeps zeros positive
        for (double& entry : geometry.direction[row]) entry = 0 - entry;
        geometry.origin[row] = 0 - geometry.origin[row];
    }
    geometry.space = space;
    return geometry;
}

}  // namespace isoatlas
