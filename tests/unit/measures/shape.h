// Shapes whose measures are known, sampled on grids of every kind.
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "isoatlas/measures.h"
#include "measures/vectors.h"

namespace isoatlas::shapes {

/// Positive inside; in the coordinates of space.
using Field = std::function<double(const Vec3&)>;

struct GridKind {
    std::string name;
    Geometry geometry;  ///< with steps of about 1
};

inline void PrintTo(const GridKind& kind, std::ostream* out) { *out << kind.name; }

/// Steps that change from sample to sample, about 1 on average; smooth, so that errors are of second order.
inline std::vector<double> uneven(std::size_t count) {
    std::vector<double> places;
    for (std::size_t i = 0; i < count; ++i) {
        const double x = static_cast<double>(i) / static_cast<double>(count - 1);
        places.push_back(static_cast<double>(count - 1) * (x + 0.08 * std::sin(6.283185307179586 * x)));
    }
    return places;
}

inline std::vector<GridKind> grid_kinds() {
    const double c = std::cos(0.5), s = std::sin(0.5);
    std::vector<GridKind> kinds(6);
    kinds[0].name = "even";
    kinds[1].name = "anisotropic", kinds[1].geometry.spacing = {0.5, 1, 1.25};
    kinds[2].name = "oblique", kinds[2].geometry.direction = {{{c, -s * 0.8, s * 0.6}, {s, c * 0.8, -c * 0.6}, {0, 0.6, 0.8}}};
    kinds[2].geometry.spacing = {1, 0.75, 1.25};
    kinds[3].name = "mirrored", kinds[3].geometry.direction = {{{0, -1, 0}, {-1, 0, 0}, {0, 0, 1}}};
    kinds[4].name = "sheared", kinds[4].geometry.direction = {{{1, 0.6, 0}, {0, 0.8, 0}, {0, 0, 1}}};
    kinds[5].name = "uneven";  // coordinates follow with the number of samples
    return kinds;
}

/// A volume of steps of about h around the origin of space, at least `reach` in every direction of the grid.
inline Volume sample(const Field& field, GridKind kind, double h, double reach, int rank = 3) {
    Geometry& geometry = kind.geometry;
    Extent extent{rank, {1, 1, 1}};
    Vec3 middle{};
    const double stretch = kind.name == "sheared" ? 1.7 : 1;  // the cube of the axes is narrower than its edges
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(rank); ++axis) {
        geometry.spacing[axis] *= h;
        const auto half = static_cast<std::int64_t>(std::ceil(stretch * 1.4 * reach / geometry.spacing[axis])) + 2;
        extent.size[axis] = 2 * half + 1;
        if (kind.name == "uneven") {
            geometry.coordinates[axis] = uneven(static_cast<std::size_t>(extent.size[axis]));
            for (double& place : geometry.coordinates[axis]) place *= h;
        }
        middle[axis] = static_cast<double>(half) + 0.3;  // no sample in the middle
    }
    geometry.unit = "mm";
    const Vec3 offset = to_physical(geometry, middle);
    geometry.origin = minus({3, -5, 200}, offset);  // the middle of the shape lies at (3, -5, 200)
    Volume volume = make_volume(extent, ValueType::f64, geometry);
    const std::span<double> samples = volume.samples<double>();
    for (std::int64_t v = 0; v < extent.voxels(); ++v) {
        const Index3 at = extent.voxel(v);
        const Vec3 place = to_physical(geometry, {static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])});
        samples[static_cast<std::size_t>(v)] = field(minus(place, {3, -5, 200}));
    }
    return volume;
}

inline constexpr Vec3 kMiddle{3, -5, 200};

/// The only object at 0.
inline ObjectMeasures measure(const Volume& volume) {
    const std::vector<ObjectMeasures> objects = measure_objects(volume, 0);
    if (objects.size() != 1) throw std::runtime_error(std::to_string(objects.size()) + " objects");
    return objects[0];
}

inline Field ball(double radius) {
    return [=](const Vec3& p) { return radius - norm(p); };
}
/// Along the axes a, b, c of space turned about z by `angle`.
inline Field ellipsoid(const Vec3& half, double angle) {
    return [=](const Vec3& p) {
        const double c = std::cos(angle), s = std::sin(angle);
        const Vec3 q{(c * p[0] + s * p[1]) / half[0], (c * p[1] - s * p[0]) / half[1], p[2] / half[2]};
        return 1 - norm(q);
    };
}
inline Field torus(double large, double small) {
    return [=](const Vec3& p) { return small - std::hypot(std::hypot(p[0], p[1]) - large, p[2]); };
}
inline Field shell(double inner, double outer) {
    return [=](const Vec3& p) { return std::min(outer - norm(p), norm(p) - inner); };
}
inline Field box(const Vec3& half) {
    return [=](const Vec3& p) { return std::min({half[0] - std::abs(p[0]), half[1] - std::abs(p[1]), half[2] - std::abs(p[2])}); };
}

}  // namespace isoatlas::shapes
