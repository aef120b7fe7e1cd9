// Area and volume of surfaces.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace isoatlas {

struct Context;
struct Surface;

/// Physical area of the surface, and the volume that it encloses (2D: length, area). The order of summation does not depend on threads.
struct SurfaceSize {
    double area = 0, measure = 0;
};

/// Of a closed surface: normals point outwards. Cost: O(triangles).
[[nodiscard]] SurfaceSize size_of_surface(const Surface& surface, const Context& context);

/// One object of a surface with ids.
struct ObjectSize : SurfaceSize {
    std::int64_t object = 0;  ///< id
    std::int64_t triangles = 0;
    std::array<double, 3> low{}, high{};  ///< of its points, physical
};

/// Of each object of a closed 3D surface with ids, by id. Cost: O(triangles + points log objects).
[[nodiscard]] std::vector<ObjectSize> sizes_of_objects(const Surface& surface);

}  // namespace isoatlas
