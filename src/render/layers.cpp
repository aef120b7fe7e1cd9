#include "render/layers.h"

#include <algorithm>
#include <cmath>

#include "render/colours.h"

namespace isoatlas {
namespace {

constexpr double kOnSurface = 1e-5;  // a slice so close to an opaque surface, such as a cut face, lies on it

/// Colour and opacity of a picture at (u, v) in the unit square, between its pixels.
Layer look_up(const Image& picture, double u, double v) {
    const double x = std::clamp(u * static_cast<double>(picture.width) - 0.5, 0.0, static_cast<double>(picture.width - 1));
    const double y = std::clamp(v * static_cast<double>(picture.height) - 0.5, 0.0, static_cast<double>(picture.height - 1));
    const auto x0 = static_cast<std::int64_t>(x), y0 = static_cast<std::int64_t>(y);
    const double fx = x - static_cast<double>(x0), fy = y - static_cast<double>(y0);
    double sum[4] = {};
    for (int corner = 0; corner < 4; ++corner) {
        const double weight = ((corner & 1) != 0 ? fx : 1 - fx) * ((corner & 2) != 0 ? fy : 1 - fy);
        const std::uint8_t* pixel =
            picture.at(std::min(x0 + (corner & 1), picture.width - 1), std::min(y0 + (corner >> 1), picture.height - 1));
        for (int c = 0; c < 4; ++c) sum[c] += weight * pixel[c] / 255;
    }
    return {0, {to_linear(sum[0]), to_linear(sum[1]), to_linear(sum[2])}, sum[3]};
}

}  // namespace

RaySlices::RaySlices(const Scene& scene, const Frame& frame) {
    for (const SceneSlice& slice : scene.slices) {
        const Vec3 across = scale(slice.across, 1 / frame.radius), down = scale(slice.down, 1 / frame.radius);
        planes_.push_back({&slice.picture, frame.inside(slice.corner), across, down, cross(across, down)});
    }
}

void RaySlices::add(const Ray& ray, double max, std::vector<Layer>& layers) const {
    for (const Plane& plane : planes_) {
        const double speed = dot(ray.direction, plane.normal);
        if (speed == 0) continue;
        const double t = dot(minus(plane.corner, ray.origin), plane.normal) / speed;
        if (!(t > 0 && t < max + kOnSurface)) continue;
        const Vec3 from = minus(along(ray.origin, t, ray.direction), plane.corner);
        const double square = dot(plane.normal, plane.normal);
        const double u = dot(cross(from, plane.down), plane.normal) / square, v = dot(cross(plane.across, from), plane.normal) / square;
        if (u < 0 || u > 1 || v < 0 || v > 1) continue;
        Layer layer = look_up(*plane.picture, u, v);
        layer.t = std::min(t, max);
        layers.push_back(layer);
    }
}

}  // namespace isoatlas
