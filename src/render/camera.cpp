// Cameras: rays through pixels, points in the picture, and a camera that shows everything.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "render/camera_rays.h"
#include "render/scene_box.h"

namespace isoatlas {

namespace {
constexpr double kMargin = 1.06;      // of the fitted picture, around the scene
constexpr double kEyeDistance = 3.5;  // of perspective cameras, in radii of the scene: a moderate telephoto lens
}  // namespace

CameraRays::CameraRays(const Camera& camera, std::int64_t width, std::int64_t height)
    : camera_(camera), width_(static_cast<double>(width)), height_(static_cast<double>(height)), pixel_(camera.height / height_) {
    toward = unit(camera.view.toward);
    right = unit(cross(camera.view.up, toward));
    if (norm(right) == 0) basis_of(toward, right, up);
    up = cross(toward, right);
}

Ray CameraRays::through(double x, double y, double behind) const {
    const Vec3 point = along(along(camera_.target, (x - width_ / 2) * pixel_, right), (height_ / 2 - y) * pixel_, up);
    if (camera_.projection == Projection::orthographic) return {along(point, behind, toward), scale(toward, -1)};
    const Vec3 eye = along(camera_.target, camera_.distance, toward);
    return {eye, unit(minus(point, eye))};
}

Vec3 CameraRays::project(const Vec3& point) const {
    const Vec3 from = minus(point, camera_.target);
    const double depth = dot(from, toward);
    const double nearer = camera_.projection == Projection::orthographic ? 1 : camera_.distance / (camera_.distance - depth);
    return {width_ / 2 + nearer * dot(from, right) / pixel_, height_ / 2 - nearer * dot(from, up) / pixel_, depth};
}

double CameraRays::eye_depth() const {
    return camera_.projection == Projection::orthographic ? std::numeric_limits<double>::infinity() : camera_.distance;
}

namespace {

struct Span {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    void take(double x) { low = std::min(low, x), high = std::max(high, x); }
};

}  // namespace

Camera fit_camera(const Scene& scene, const View& view, const RenderOptions& options) {
    const SceneBox box = box_of(scene);
    Camera camera{.projection = options.projection, .target = box.centre(), .view = view};
    camera.distance = kEyeDistance * box.radius();
    const std::vector<Vec3> shown = shown_corners_of(scene.volume);
    Span across, upwards;
    const auto measure = [&] {
        const CameraRays rays(camera, options.width, options.height);
        across = {}, upwards = {};
        const auto take = [&](const Vec3& point) {
            const Vec3 p = rays.project(point);
            across.take(p[0]), upwards.take(p[1]);
        };
        for_each_outline_point(scene, take);
        for (const Vec3& corner : shown) take(corner);
        return rays;
    };
    // Centres the visible part; perspective shifts slightly when the target moves, hence two iterations.
    for (int round = 0; round < 2; ++round) {
        const CameraRays rays = measure();
        const double x = (across.low + across.high) / 2 - static_cast<double>(options.width) / 2;
        const double y = (upwards.low + upwards.high) / 2 - static_cast<double>(options.height) / 2;
        camera.target = along(along(camera.target, x * rays.pixel_size(), rays.right), -y * rays.pixel_size(), rays.up);
    }
    measure();
    const double filled = std::max((across.high - across.low) / static_cast<double>(options.width),
                                   (upwards.high - upwards.low) / static_cast<double>(options.height));
    camera.height *= std::max(filled * kMargin, 1e-12);
    return camera;
}

Camera fit_turntable(const Scene& scene, const View& view, const Vec3& up, const RenderOptions& options) {
    const SceneBox box = box_of(scene);
    const Vec3 axis = unit(up);
    double around = 0, along = 0;
    const auto take = [&](const Vec3& point) {
        const Vec3 from = minus(point, box.centre());
        const double height = dot(from, axis);
        around = std::max(around, norm(isoatlas::along(from, -height, axis)));
        along = std::max(along, std::abs(height));
    };
    for_each_outline_point(scene, take);
    for (const Vec3& corner : shown_corners_of(scene.volume)) take(corner);
    const double sine = std::abs(dot(axis, view.toward)), cosine = std::sqrt(std::max(0.0, 1 - sine * sine));
    const double shape = static_cast<double>(options.height) / static_cast<double>(options.width);
    Camera camera{.projection = options.projection, .target = box.centre(), .view = view};
    camera.distance = kEyeDistance * box.radius();
    camera.height = 2 * kMargin * std::max({along * cosine + around * sine, around * shape, 1e-12});
    if (camera.projection == Projection::perspective) camera.height *= camera.distance / (camera.distance - around);
    return camera;
}

View rotated(const View& view, const Vec3& axis, double degrees) {
    const Vec3 z = unit(axis);
    const double angle = degrees * std::numbers::pi / 180, cosine = std::cos(angle), sine = std::sin(angle);
    const auto turn = [&](const Vec3& v) { return plus(along(scale(v, cosine), sine, cross(z, v)), scale(z, dot(z, v) * (1 - cosine))); };
    return {turn(view.toward), turn(view.up)};
}

Vec3 project(const Camera& camera, const RenderOptions& options, const Vec3& point) {
    return CameraRays(camera, options.width, options.height).project(point);
}

}  // namespace isoatlas
