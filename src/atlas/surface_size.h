// Area and volume of surfaces.
#pragma once

namespace isoatlas {

struct Context;
struct Surface;

/// Physical area of the surface, and the volume that it encloses (2D: length, area). The order of summation does not depend on threads.
struct SurfaceSize {
    double area = 0, measure = 0;
};

/// Of a closed surface: normals point outwards. Cost: O(triangles).
[[nodiscard]] SurfaceSize size_of_surface(const Surface& surface, const Context& context);

}  // namespace isoatlas
