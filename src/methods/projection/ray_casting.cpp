// Ray casting (Levoy, 1988): a ray a pixel, samples at even steps, trilinear between samples of the volume, composited front to back.
#include <algorithm>

#include "base/cancel.h"
#include "methods/projection/projector.h"

namespace isoatlas {
namespace {

/// The trilinear interpolant at a place inside of the volume, in samples.
float trilinear(const Projector& projector, const Vec3& place) {
    const Extent& extent = projector.info.extent;
    std::int64_t first = 0, step[3];
    double part[3];
    const std::int64_t stride[3] = {1, extent.size[0], extent.slice()};
    for (int a = 0; a < 3; ++a) {
        const std::int64_t cell =
            std::clamp<std::int64_t>(static_cast<std::int64_t>(place[a]), 0, std::max<std::int64_t>(0, extent.size[a] - 2));
        part[a] = std::clamp(place[a] - static_cast<double>(cell), 0.0, 1.0);
        first += cell * stride[a], step[a] = extent.size[a] > 1 ? stride[a] : 0;
    }
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
        double weight = 1;
        std::int64_t at = first;
        for (int a = 0; a < 3; ++a) {
            const bool is_next = (corner >> a & 1) != 0;
            weight *= is_next ? part[a] : 1 - part[a], at += is_next ? step[a] : 0;
        }
        sum += weight * static_cast<double>(projector.values[at]);
    }
    return static_cast<float>(sum);
}

/// t between which a ray is inside of the volume.
std::array<double, 2> inside(const Extent& extent, const Ray& ray) {
    std::array<double, 2> t{-INFINITY, INFINITY};
    for (int a = 0; a < 3; ++a) {
        const auto last = static_cast<double>(extent.size[a] - 1);
        if (ray.direction[a] == 0) {
            if (ray.origin[a] < 0 || ray.origin[a] > last) return {0, 0};
            continue;
        }
        const double from = -ray.origin[a] / ray.direction[a], to = (last - ray.origin[a]) / ray.direction[a];
        t = {std::max(t[0], std::min(from, to)), std::min(t[1], std::max(from, to))};
    }
    return t;
}

}  // namespace

void cast_rays(const Projector& projector, ProjectedPicture& picture) {
    const double step = projector.options.step * std::ranges::min(projector.info.geometry.spacing);
    for (std::int64_t y = 0; y < picture.height; ++y) {
        stop_if_cancelled(projector.context);
        for (std::int64_t x = 0; x < picture.width; ++x) {
            const Ray ray = projector.ray_of(x, y);
            const auto [begin, end] = inside(projector.info.extent, ray);
            std::array<float, 4>& pixel = picture.pixels[x + picture.width * y];
            for (double t = begin; t < end && 1 - pixel[3] > kUnseen; t += step) {
                const double length = std::min(step, end - t);  // its middle stands for a segment
                const OpticalProperties matter = projector.matter(trilinear(projector, along(ray.origin, t + length / 2, ray.direction)));
                ++picture.samples;
                if (matter.extinction > 0) put_behind(pixel, matter.extinction * length, scale(matter.glow, length));
            }
        }
    }
}

}  // namespace isoatlas
