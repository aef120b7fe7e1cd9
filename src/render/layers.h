// Transparent layers in front of the opaque surface along a ray: thin sheets and slices, front to back.
#pragma once

#include <optional>
#include <vector>

#include "isoatlas/render.h"
#include "render/ray_surfaces.h"

namespace isoatlas {

struct Layer {
    double t;
    Vec3 light;  ///< not premultiplied
    double opacity;
};

/// Pictures in space, in the frame.
class RaySlices {
public:
    RaySlices(const Scene& scene, const Frame& frame);
    /// Adds a layer for every picture that the ray crosses at t <= `max`.
    void add(const Ray& ray, double max, std::vector<Layer>& layers) const;

private:
    struct Plane {
        const Image* picture;
        Vec3 corner, across, down, normal;
    };
    std::vector<Plane> planes_;
};

}  // namespace isoatlas
