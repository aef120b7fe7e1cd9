// What the methods of this room share: matter at samples, places of samples in the picture, and composition front to back.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "isoatlas/projection_methods.h"
#include "render/camera_rays.h"
#include "render/transfer.h"

namespace isoatlas {

/// Transmission below which nothing is seen.
inline constexpr float kUnseen = 1e-4F;

struct Projector {
    const VolumeInfo& info;
    std::vector<float> values;  ///< of all samples
    Transfer transfer;
    CameraRays rays;
    ProjectionOptions options;
    Context context;
    std::array<Vec3, 3> axis;     ///< from one sample to the next, physical
    std::array<Vec3, 3> inverse;  ///< rows: physical difference to sample difference

    [[nodiscard]] OpticalProperties matter(float value) const {
        const double place = transfer.place(static_cast<double>(value));
        return transfer.mean(place, place);
    }
    [[nodiscard]] Vec3 in_samples(const Vec3& way) const { return {dot(inverse[0], way), dot(inverse[1], way), dot(inverse[2], way)}; }
    /// The ray of a pixel, in samples; t is physical.
    [[nodiscard]] Ray ray_of(std::int64_t x, std::int64_t y) const {
        const Ray ray = rays.through(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5, 0);
        return {in_samples(minus(ray.origin, info.geometry.origin)), in_samples(ray.direction)};
    }
    [[nodiscard]] ProjectedPicture blank() const {
        return {
            .width = options.width, .height = options.height, .pixels = std::vector<std::array<float, 4>>(options.width * options.height)};
    }
};

/// Puts matter behind what a pixel shows: extinction times length, and glow times length.
inline void put_behind(std::array<float, 4>& pixel, double depth, const Vec3& glow) {
    const double opacity = -std::expm1(-depth), weight = static_cast<double>(1 - pixel[3]) * opacity;
    for (int c = 0; c < 3; ++c) pixel[c] += static_cast<float>(weight * glow[c] / depth);
    pixel[3] += static_cast<float>(weight);
}

void cast_rays(const Projector& projector, ProjectedPicture& picture);
void splat(const Projector& projector, ProjectedPicture& picture);
void shear_and_warp(const Projector& projector, ProjectedPicture& picture);

}  // namespace isoatlas
