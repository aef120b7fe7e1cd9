#include "render/lights.h"

#include <algorithm>
#include <numbers>

namespace isoatlas {
namespace {

constexpr double kKey = 0.78, kSky = 0.36, kGround = 0.20, kEye = 0.12, kHighlight = 0.10;
constexpr double kKeyRadius = 0.1;  // tangent of half the angle under which the key light is seen

/// The cosine to the power of 48, which shapes the highlight.
double shine_of(double cosine) {
    const double c = std::max(0.0, cosine), c2 = c * c, c4 = c2 * c2, c16 = c4 * c4 * c4 * c4;
    return c16 * c16 * c16;
}

}  // namespace

Lights::Lights(const CameraRays& camera)
    : up_(camera.up), key_(unit(plus(along(scale(camera.right, -0.55), 0.75, camera.up), scale(camera.toward, 0.75)))) {
    basis_of(key_, key_u_, key_v_);
}

Lights::Parts Lights::parts(const Vec3& normal, double towards, const Vec3& half) const {
    const double height = 0.5 + 0.5 * dot(normal, up_);
    const double ambient = kGround + (kSky - kGround) * height + kEye * std::max(0.0, towards);
    const double facing = std::max(0.0, dot(normal, key_));
    return {ambient, kKey * facing, facing > 0 ? kHighlight * shine_of(dot(normal, half)) : 0};
}

Shade Lights::shade(const Vec3& albedo, const Vec3& normal, const Vec3& to_eye) const {
    const Parts part = parts(normal, dot(normal, to_eye), half_way(to_eye));
    return {scale(albedo, part.ambient), plus(scale(albedo, part.key), {part.highlight, part.highlight, part.highlight})};
}

Vec3 Lights::shade_sheet(const Vec3& albedo, const Vec3& normal, const Vec3& to_eye) const {
    const double facing = std::abs(dot(normal, key_));
    const double shine = shine_of(dot(normal, half_way(to_eye)));
    const double highlight = 3 * kHighlight * shine;
    return plus(scale(albedo, kSky + kEye + 0.7 * kKey * facing), {highlight, highlight, highlight});
}

Vec3 Lights::to_key(Sample2 sample) const {
    const double r = kKeyRadius * std::sqrt(sample.u), angle = 2 * std::numbers::pi * sample.v;
    return unit(along(along(key_, r * std::cos(angle), key_u_), r * std::sin(angle), key_v_));
}

Vec3 to_sky(const Vec3& normal, Sample2 sample) {
    Vec3 u, v;
    basis_of(normal, u, v);
    const double r = std::sqrt(sample.u), angle = 2 * std::numbers::pi * sample.v;
    return unit(along(along(scale(normal, std::sqrt(1 - sample.u)), r * std::cos(angle), u), r * std::sin(angle), v));
}

double sheet_opacity(double opacity, double cosine) { return 1 - std::pow(1 - opacity, 1 / std::max(0.08, std::abs(cosine))); }

}  // namespace isoatlas
