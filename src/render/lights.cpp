#include "render/lights.h"

#include <algorithm>
#include <numbers>

#include "base/target_clones.h"

namespace isoatlas {
namespace {

constexpr double kKey = 0.78, kSky = 0.36, kGround = 0.20, kEye = 0.12, kHighlight = 0.10;
constexpr double kKeyRadius = 0.1;  // tangent of half the angle under which the key light is seen

/// The cosine to the power of 48, which shapes the highlight.
[[gnu::always_inline]] inline double shine_of(double cosine) {
    const double c = std::max(0.0, cosine), c2 = c * c, c4 = c2 * c2, c16 = c4 * c4 * c4 * c4;
    return c16 * c16 * c16;
}

/// Of the cosines of a normal with the directions to the key light, up, half way from it to the eye, and to the eye.
[[gnu::always_inline]] inline Lights::Parts parts_of(double key, double up, double half, double eye) {
    const double ambient = kGround + (kSky - kGround) * (0.5 + 0.5 * up) + kEye * std::max(0.0, eye);
    return {ambient, kKey * std::max(0.0, key), key > 0 ? kHighlight * shine_of(half) : 0};
}

using Doubles = double __attribute__((vector_size(32)));

/// A sum of three vectors.
[[gnu::always_inline]] inline void sum_of(const Vec3& weights, const std::array<std::array<double, 4>, 3>& vectors, Doubles& sum) {
    sum = weights[0] * __builtin_bit_cast(Doubles, vectors[0]) + weights[1] * __builtin_bit_cast(Doubles, vectors[1]) +
          weights[2] * __builtin_bit_cast(Doubles, vectors[2]);
}

}  // namespace

Lights::Lights(const CameraRays& camera)
    : up_(camera.up), key_(unit(plus(along(scale(camera.right, -0.55), 0.75, camera.up), scale(camera.toward, 0.75)))) {
    basis_of(key_, key_u_, key_v_);
}

Lights::GradientView Lights::gradient_view(const Mat3& to_voxel, const Vec3& to_eye) const {
    const Vec3 half = half_way(to_eye);
    GradientView view{};
    for (std::size_t a = 0; a < 3; ++a) {
        const Vec3& physical = to_voxel[static_cast<int>(a)];  // the gradient is the transpose of to_voxel times the differences
        view.physical[a] = {physical[0], physical[1], physical[2], 0};
        view.along[a] = {dot(physical, key_), dot(physical, up_), dot(physical, half), dot(physical, to_eye)};
    }
    return view;
}

ISOATLAS_TARGET_CLONES void Lights::parts(const Vec3& fall, const GradientView& view, Parts& found) {
    Doubles normal, cosines;
    sum_of(fall, view.physical, normal);
    const double squared = normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2];
    if (squared == 0) {
        found = {0.6, 0, 0};
        return;
    }
    sum_of(fall, view.along, cosines);
    cosines *= (cosines[3] < 0 ? -1 : 1) / __builtin_sqrt(squared);
    found = parts_of(cosines[0], cosines[1], cosines[2], cosines[3]);
}

Shade Lights::shade(const Vec3& albedo, const Vec3& normal, const Vec3& to_eye) const {
    const Parts part = parts_of(dot(normal, key_), dot(normal, up_), dot(normal, half_way(to_eye)), dot(normal, to_eye));
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
