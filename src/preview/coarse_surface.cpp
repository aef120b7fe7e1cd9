#include "preview/coarse_surface.h"

#include <meshoptimizer.h>

#include <limits>
#include <vector>

namespace isoatlas {

Surface coarse_surface(Surface surface, std::size_t max) {
    if (surface.triangles.size() <= max) return surface;
    std::vector<unsigned> corners;
    corners.reserve(3 * surface.triangles.size());
    for (const auto& triangle : surface.triangles) {
        for (const std::int64_t corner : triangle) corners.push_back(static_cast<unsigned>(corner));
    }
    std::vector<float> positions;
    positions.reserve(3 * surface.points.size());
    for (const auto& point : surface.points) {
        for (const double coordinate : point) positions.push_back(static_cast<float>(coordinate));
    }
    std::vector<unsigned> kept(corners.size());
    kept.resize(meshopt_simplifySloppy(kept.data(), corners.data(), corners.size(), positions.data(), surface.points.size(),
                                       3 * sizeof(float), 3 * max, std::numeric_limits<float>::max(), nullptr));
    surface.triangles.resize(kept.size() / 3);
    for (std::size_t i = 0; i < kept.size(); ++i) surface.triangles[i / 3][i % 3] = kept[i];
    return surface;
}

}  // namespace isoatlas
