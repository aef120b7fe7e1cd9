// Shading: one key light with a soft shadow from above left, ambient light with ambient occlusion, a weak headlight. Diffuse surfaces with
// a faint highlight. All in linear light.
#pragma once

#include "render/camera_rays.h"
#include "render/samples.h"
#include "render/vectors.h"

namespace isoatlas {

/// Light of a point towards the camera, in parts, so that visibility of lights can be denoised before it is applied.
struct Shade {
    Vec3 ambient{};  ///< to be multiplied by the visible part of the sky
    Vec3 key{};      ///< to be multiplied by the visible part of the key light
};

class Lights {
public:
    /// The lights are fixed to the camera.
    explicit Lights(const CameraRays& camera);

    /// normal: towards the eye.
    [[nodiscard]] Shade shade(const Vec3& albedo, const Vec3& normal, const Vec3& to_eye) const;
    /// The same for any albedo: what to multiply it by, and what the key light adds, whatever its colour.
    struct Parts {
        double ambient, key, highlight;
    };
    /// How negative gradients, given as differences along the axes of samples, lie to one eye and its lights.
    struct GradientView {
        std::array<std::array<double, 4>, 3> physical;  ///< of a difference of 1 along each axis; the fourth is 0
        std::array<std::array<double, 4>, 3> along;     ///< the same, along: key light, up, half way from it to the eye, eye
    };
    /// to_voxel: rows: physical difference to sample difference.
    [[nodiscard]] GradientView gradient_view(const Mat3& to_voxel, const Vec3& to_eye) const;
    /// Where the surface that the gradient belongs to is seen from either side. Without a gradient: some ambient light.
    static void parts(const Vec3& fall, const GradientView& view, Parts& found);
    /// A thin sheet: lit from both sides, with no shadow.
    [[nodiscard]] Vec3 shade_sheet(const Vec3& albedo, const Vec3& normal, const Vec3& to_eye) const;
    /// A direction to a point of the key light, which is a disk.
    [[nodiscard]] Vec3 to_key(Sample2 sample) const;

private:
    /// The unit vector between the directions to the key light and to the eye.
    [[nodiscard]] Vec3 half_way(const Vec3& to_eye) const { return unit(plus(key_, to_eye)); }

    Vec3 up_, key_, key_u_, key_v_;
};

/// A direction around the normal, cosine-weighted.
[[nodiscard]] Vec3 to_sky(const Vec3& normal, Sample2 sample);

/// Opacity of a sheet at a given cosine of the viewing angle: the path through it is longer at its rim.
[[nodiscard]] double sheet_opacity(double opacity, double cosine);

}  // namespace isoatlas
