// Best view by viewpoint entropy (Vazquez, Feixas, Sbert, Heidrich: Viewpoint selection using viewpoint entropy, 2001).
//
// Surfaces are divided into pieces by position and normal direction. In a view, p(i) is the part of the picture that piece i takes (the
// background is a piece too); the entropy -sum p log p is large when many pieces are seen, each of a decent size.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "base/parallel.h"
#include "isoatlas/environment.h"
#include "render/camera_rays.h"
#include "render/ray_surfaces.h"
#include "render/scene_box.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kPixels = 72;           // a side of a candidate picture
constexpr int kAround = 12;                    // directions around the axis
constexpr double kElevations[] = {8, 24, 40};  // degrees; never from below, and not steeply from above
constexpr double kNearlyAsGood = 0.985;        // the first direction within this tolerance of the best, for stability against noise

std::vector<View> candidates(const Vec3& up) {
    std::vector<View> views;
    for (const double elevation : kElevations) {
        for (int i = 0; i < kAround; ++i) {
            // Starts at the front, then alternates sides.
            const int step = i % 2 == 1 ? (i + 1) / 2 : -(i / 2);
            views.push_back(view_from(360 * (step + 0.5) / kAround, elevation, up));
        }
    }
    return views;
}

/// Which piece: place in a 4 x 4 x 4 grid, and the octant its normal points to.
int piece_of(const Vec3& point, const Vec3& normal) {
    int piece = 0;
    for (int a = 0; a < 3; ++a) {
        piece = 4 * piece + std::clamp(static_cast<int>(std::floor((point[a] + 1) * 2)), 0, 3);
        piece = 2 * piece + (normal[a] > 0 ? 1 : 0);
    }
    return piece;
}

double entropy_of(const RaySurfaces& surfaces, const View& view) {
    const Camera camera{.view = view, .height = 2};
    const CameraRays rays(camera, kPixels, kPixels);
    std::map<int, std::int64_t> pixels;
    for (std::int64_t y = 0; y < kPixels; ++y) {
        for (std::int64_t x = 0; x < kPixels; ++x) {
            const Ray ray = rays.through(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5, 2);
            const std::optional<Crossing> hit = surfaces.first(ray);
            ++pixels[hit ? piece_of(along(ray.origin, hit->t, ray.direction), hit->normal) : -1];
        }
    }
    double entropy = 0;
    for (const auto& [piece, count] : pixels) {
        const double p = static_cast<double>(count) / (kPixels * kPixels);
        entropy -= p * std::log2(p);
    }
    return entropy;
}

}  // namespace

View view_from(double around, double above, const Vec3& up) {
    const double a = around * std::numbers::pi / 180, b = above * std::numbers::pi / 180;
    const Vec3 toward{std::cos(b) * std::sin(a), -std::cos(b) * std::cos(a), std::sin(b)};
    const Vec3 above_it{-std::sin(b) * std::sin(a), std::sin(b) * std::cos(a), std::cos(b)};
    const Vec3 z = unit(up);
    const auto rotated = [&](const Vec3& v) -> Vec3 {
        if (z[2] <= -1 + 1e-12) return {-v[0], v[1], -v[2]};
        // v + axis x v + axis x (axis x v) / (1 + cos), axis = z x up (Rodrigues).
        const Vec3 axis{-z[1], z[0], 0}, once = cross(axis, v);
        return along(plus(v, once), 1 / (1 + z[2]), cross(axis, once));
    };
    return {rotated(toward), rotated(above_it)};
}

View best_view(const Scene& scene, const Vec3& up, const Context& context) {
    const EnvironmentScope scope(context);
    const SceneBox box = box_of(scene);
    const Frame frame{box.centre(), box.radius()};
    const std::vector<HalfSpace> none;
    // Surfaces behind transparent ones count less; where nothing is opaque, the transparent surface counts.
    const auto which = std::any_of(scene.objects.begin(), scene.objects.end(), [](const SceneObject& o) { return o.opacity >= 1; })
                           ? RaySurfaces::Which::opaque
                           : RaySurfaces::Which::transparent;
    const RaySurfaces surfaces(scene, which, frame, none, context.threads);
    const std::vector<View> views = candidates(up);
    std::vector<double> entropy(views.size());
    for_each_block(context.threads, static_cast<std::int64_t>(views.size()),
                   [&](std::int64_t i) { entropy[i] = entropy_of(surfaces, views[i]); });
    const double best = *std::max_element(entropy.begin(), entropy.end());
    for (std::size_t i = 0; i < views.size(); ++i) {
        if (entropy[i] >= kNearlyAsGood * best) return views[i];
    }
    return views[0];
}

}  // namespace isoatlas
