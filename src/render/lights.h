// How a surface looks: one key light with a soft shadow from above left, light from all around with ambient occlusion, a little light from
// the eye. Diffuse surfaces with a faint highlight. All in linear light.
#pragma once

#include "render/camera_rays.h"
#include "render/samples.h"
#include "render/vectors.h"

namespace isoatlas {

/// What a point sends to the eye, in parts, so that what is in the way of light can be known later and be smoothed first.
struct Shade {
    Vec3 ambient{};  ///< times the open part of the sky
    Vec3 key{};      ///< times the visible part of the key light
};

class Lights {
public:
    /// They stand around the camera.
    explicit Lights(const CameraRays& camera);

    /// normal: towards the eye.
    [[nodiscard]] Shade shade(const Vec3& albedo, const Vec3& normal, const Vec3& to_eye) const;
    /// A thin sheet: lit from both sides, with no shadow.
    [[nodiscard]] Vec3 shade_sheet(const Vec3& albedo, const Vec3& normal, const Vec3& to_eye) const;
    /// A direction to a point of the key light, which is a disk.
    [[nodiscard]] Vec3 to_key(Sample2 sample) const;

private:
    Vec3 up_, toward_, key_, key_u_, key_v_;
};

/// A direction around the normal, cosine-weighted.
[[nodiscard]] Vec3 to_sky(const Vec3& normal, Sample2 sample);

/// Opacity of a sheet seen under an angle whose cosine is given: the way through it is longer, so its rim is denser.
[[nodiscard]] double sheet_opacity(double opacity, double cosine);

}  // namespace isoatlas
