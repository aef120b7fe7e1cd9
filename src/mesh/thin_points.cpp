#include "mesh/thin_points.h"

#include <array>
#include <cmath>

#include "base/check.h"
#include "base/parallel.h"
#include "base/systematic_sample.h"
#include "geometry/vectors.h"

namespace isoatlas {
namespace {

/// The steps along each axis, divided by the volume of a cell.
std::array<Vec3, 3> crossings_of(const Geometry& geometry) {
    std::array<Vec3, 3> steps;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (std::size_t row = 0; row < 3; ++row) steps[axis][row] = geometry.direction[row][axis] * geometry.spacing[axis];
    }
    const double volume = std::abs(dot(steps[0], cross(steps[1], steps[2])));
    for (Vec3& step : steps) {
        for (double& part : step) part /= volume;
    }
    return steps;
}

}  // namespace

BigVector<float> areas_of_hits(IdSpan<ContourNumber, const std::uint8_t> chosen, const Geometry& geometry, const Context& context,
                               const Surface& surface) {
    ISOATLAS_CHECK(surface.normals.size() == surface.points.size());
    const std::array<Vec3, 3> crossings = crossings_of(geometry);
    const bool are_all = chosen.empty();
    BigVector<float> areas;
    resize_for_overwrite(areas, surface.points.size());
    for_each_index(context.threads, areas.size(), [&](std::size_t i) {
        const bool is_chosen = are_all || chosen[ContourNumber(surface.contour[i])] != 0;
        const auto& [x, y, z] = surface.normals[i];
        double crossed = 0;
        for (const Vec3& step : crossings) crossed += std::abs(dot(step, {x, y, z}));
        areas[i] = is_chosen ? static_cast<float>(1 / crossed) : 0;
    });
    return areas;
}

double thin_points(const BigVector<float>& areas, std::int64_t wanted, const Context& context, Surface& surface) {
    ISOATLAS_CHECK(surface.triangles.empty() && areas.size() == surface.points.size() && wanted > 0);
    const SystematicSample sample(std::ssize(areas), context.threads, [&](std::int64_t i) { return static_cast<double>(areas[i]); });
    const double part = sample.total() / static_cast<double>(wanted);
    Array<Vec3> points;
    Array<std::array<float, 3>> normals;
    if (part > 0) {
        points.resize(sample.count(part));
        normals.resize(sample.count(part));
        sample.for_each(part, [&](std::int64_t i, std::int64_t k) { points[k] = surface.points[i], normals[k] = surface.normals[i]; });
    }
    surface.points.swap(points);
    surface.normals.swap(normals);
    surface.contour.clear();
    return part;
}

}  // namespace isoatlas
