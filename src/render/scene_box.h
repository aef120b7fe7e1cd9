// Bounding box of a scene.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "isoatlas/render.h"
#include "render/vectors.h"

namespace isoatlas {

struct SceneBox {
    Vec3 low{kFar, kFar, kFar}, high{-kFar, -kFar, -kFar};

    void take(const Vec3& p) {
        for (int a = 0; a < 3; ++a) low[a] = std::min(low[a], p[a]), high[a] = std::max(high[a], p[a]);
    }
    [[nodiscard]] bool empty() const { return low[0] > high[0]; }
    [[nodiscard]] Vec3 centre() const { return scale(plus(low, high), 0.5); }
    /// Radius of a ball around the centre that contains the box; above 0.
    [[nodiscard]] double radius() const { return std::max(norm(minus(high, low)) / 2, 1e-30); }

private:
    static constexpr double kFar = std::numeric_limits<double>::infinity();
};

/// Corners of the whole volume; none without a volume.
std::vector<Vec3> corners_of(const SceneVolume& volume);
/// Corners of the box around the samples that the transfer function shows; of the whole volume when it shows nothing. Cost: O(volume).
std::vector<Vec3> shown_corners_of(const SceneVolume& volume);

/// Calls function(point) with points whose convex hull contains everything in the scene but its volume.
template <class Function>
void for_each_outline_point(const Scene& scene, const Function& function) {
    for (const SceneObject& object : scene.objects) {
        for (const Vec3& point : object.surface.points) function(point);
    }
    for (const SceneSlice& slice : scene.slices) {
        for (int i = 0; i < 4; ++i) function(along(along(slice.corner, i & 1, slice.across), i >> 1, slice.down));
    }
}

/// Around everything, all of the volume included.
/// Throws Error{not_found} for an empty scene.
SceneBox box_of(const Scene& scene);

}  // namespace isoatlas
