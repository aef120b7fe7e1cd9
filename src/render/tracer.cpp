#include "render/tracer.h"

#include <algorithm>

#include "render/colours.h"

namespace isoatlas {
namespace {

constexpr int kSkyRays = 2;     // per sample
constexpr double kReach = 0.5;  // range of ambient occlusion
constexpr double kMaxLift = 0.01;

std::vector<HalfSpace> in_frame(const std::vector<HalfSpace>& removed, const Frame& frame) {
    std::vector<HalfSpace> inside;
    for (const HalfSpace& half : removed) {
        const double size = norm(half.normal);
        const Vec3 normal = unit(half.normal);
        inside.push_back({normal, (half.offset / size - dot(normal, frame.centre)) / frame.radius});
    }
    return inside;
}

/// Ray offset as a fraction of a triangle's edge, to avoid hits of neighbouring triangles.
double lift_of(const Scene& scene, const Frame& frame) {
    double sum = 0, count = 0;
    for (const SceneObject& object : scene.objects) {
        const auto& triangles = object.surface.triangles;
        if (triangles.empty() && object.point_radius > 0) sum += object.point_radius / frame.radius, count += 1;
        const std::size_t step = triangles.size() / 1000 + 1;
        for (std::size_t i = 0; i < triangles.size(); i += step) {
            const auto& points = object.surface.points;
            sum += norm(minus(points[triangles[i][1]], points[triangles[i][0]])) / frame.radius;
            count += 1;
        }
    }
    return count > 0 ? std::clamp(0.3 * sum / count, 1e-5, kMaxLift) : kMaxLift;
}

/// Flips towards the camera: an interpolated normal may point away from it at a silhouette.
Vec3 facing(const Vec3& normal, const Ray& ray) {
    const double lean = dot(normal, ray.direction);
    return lean <= 0 ? normal : unit(along(normal, -1.001 * lean, ray.direction));
}

}  // namespace

Tracer::Tracer(const Scene& scene, const Frame& frame, const CameraRays& camera, bool shading, int threads)
    : scene_(scene),
      shading_(shading),
      removed_(in_frame(scene.removed, frame)),
      opaque_(scene, RaySurfaces::Which::opaque, frame, removed_, threads),
      transparent_(scene, RaySurfaces::Which::transparent, frame, removed_, threads),
      slices_(scene, frame),
      lights_(camera),
      lift_(lift_of(scene, frame)) {
    for (const SceneObject& object : scene.objects) albedo_.push_back(linear(object.colour));
    if (scene.volume.volume == nullptr) return;
    medium_.emplace(scene, frame, shading ? &lights_ : nullptr, opaque_, threads);
    if (scene.objects.empty() && scene.slices.empty()) footprint_ = medium_->footprint(camera);
    if (scene.volume.optics != OpticalModel::absorption_emission)
        optics_.emplace(scene.volume, *medium_, lights_.to_key({0, 0}), opaque_, removed_);
}

Seen Tracer::trace(const Ray& ray, std::uint32_t seed, std::uint32_t sample, Workspace& work) const {
    Seen seen;
    const Gap gap = gap_of(removed_, ray);
    const std::optional<Crossing> hit = first_opaque(ray, gap, work.crossings);
    const double max = hit ? hit->t : INFINITY;
    work.layers.clear();
    add_sheets(ray, max, gap, work);
    slices_.add(ray, max, work.layers);
    if (work.layers.size() > 1)
        std::stable_sort(work.layers.begin(), work.layers.end(), [](const Layer& a, const Layer& b) { return a.t < b.t; });
    const double shift = fraction_of(hash(seed ^ 0x51ed270bU) + sample * 2654435769U);
    gather(ray, max, gap, {shift, hash(seed, sample)}, work.layers, seen);
    if (!hit) return seen;
    add_opaque(ray, *hit, seen);
    if (shading_) look_around(ray, *hit, seed, sample, seen);
    return seen;
}

/// Composites everything in front of the opaque surface, front to back: layers, and the medium between them.
void Tracer::gather(const Ray& ray, double max, const Gap& gap, const RayNumbers& numbers, const std::vector<Layer>& layers,
                    Seen& seen) const {
    Gathered gathered;
    double begin = 0;
    for (const Layer& layer : layers) {
        march(ray, begin, layer.t, gap, numbers, gathered);
        const double weight = (1 - gathered.opacity) * layer.opacity;
        gathered.light = along(gathered.light, weight, layer.light);
        gathered.opacity += weight;
        begin = layer.t;
    }
    march(ray, begin, max, gap, numbers, gathered);
    seen.glow = gathered.light, seen.opacity = gathered.opacity;
}

void Tracer::march(const Ray& ray, double begin, double end, const Gap& gap, const RayNumbers& numbers, Gathered& gathered) const {
    if (!medium_) return;
    if (optics_) return optics_->march(ray, begin, end, numbers, gathered);
    if (gap.empty()) {
        medium_->march(ray, begin, end, numbers.shift, gathered);
        return;
    }
    medium_->march(ray, begin, std::min(end, gap.begin), numbers.shift, gathered);
    medium_->march(ray, std::max(begin, gap.end), end, numbers.shift, gathered);
}

std::optional<Crossing> Tracer::first_opaque(const Ray& ray, const Gap& gap, std::vector<Crossing>& crossings) const {
    if (opaque_.empty()) return std::nullopt;
    std::optional<Crossing> hit;
    if (gap.empty()) {
        hit = opaque_.first(ray);
    } else {
        opaque_.all(ray, INFINITY, crossings);
        const auto there = std::find_if(crossings.begin(), crossings.end(), [&](const Crossing& c) { return !gap.holds(c.t); });
        if (there != crossings.end()) hit = *there;
        const std::optional<Crossing> face = cut_face(ray, gap, crossings);
        if (face && (!hit || face->t <= hit->t)) hit = face;
    }
    if (!hit) return hit;
    // Back side, seen through an open border or inside a cut.
    if (!hit->enters(ray)) hit->normal = scale(hit->normal, -1), hit->face_normal = scale(hit->face_normal, -1);
    hit->normal = facing(hit->normal, ray);
    return hit;
}

/// Exit of the ray from the clipped part, if inside an object: its last crossing entered it.
std::optional<Crossing> Tracer::cut_face(const Ray& ray, const Gap& gap, const std::vector<Crossing>& crossings) const {
    if (!(gap.end > 0) || !std::isfinite(gap.end)) return std::nullopt;
    std::vector<std::int8_t> inside(scene_.objects.size(), 0);
    for (const Crossing& crossing : crossings) {
        const bool is_closed = !scene_.objects[crossing.object].surface.triangles.empty();  // and not points
        if (is_closed && crossing.t < gap.end) inside[crossing.object] = crossing.enters(ray) ? 1 : 0;
    }
    std::int64_t best = -1;
    for (std::size_t i = 0; i < inside.size(); ++i) {
        if (inside[i] == 0) continue;
        if (best < 0 || scene_.objects[i].surface.tau > scene_.objects[best].surface.tau) best = static_cast<std::int64_t>(i);
    }
    if (best < 0) return std::nullopt;
    const Vec3 point = along(ray.origin, gap.end, ray.direction);
    const auto on = std::min_element(removed_.begin(), removed_.end(), [&](const HalfSpace& a, const HalfSpace& b) {
        return std::abs(dot(a.normal, point) - a.offset) < std::abs(dot(b.normal, point) - b.offset);
    });
    return Crossing{gap.end, best, on->normal, on->normal};
}

void Tracer::add_sheets(const Ray& ray, double max, const Gap& gap, Workspace& work) const {
    transparent_.all(ray, max, work.crossings);
    for (const Crossing& crossing : work.crossings) {
        if (gap.holds(crossing.t)) continue;
        const Vec3 normal = facing(crossing.enters(ray) ? crossing.normal : scale(crossing.normal, -1), ray);
        const Vec3 to_eye = scale(ray.direction, -1);
        const double opacity = sheet_opacity(scene_.objects[crossing.object].opacity, shading_ ? dot(normal, to_eye) : 1);
        const Vec3& albedo = albedo_[crossing.object];
        work.layers.push_back({crossing.t, shading_ ? lights_.shade_sheet(albedo, normal, to_eye) : albedo, opacity});
    }
}

void Tracer::add_opaque(const Ray& ray, const Crossing& crossing, Seen& seen) const {
    const double weight = 1 - seen.opacity;
    seen.object = crossing.object, seen.depth = crossing.t, seen.normal = crossing.normal;
    seen.opacity = 1;
    const Vec3& albedo = albedo_[crossing.object];
    if (!shading_) {
        seen.glow = along(seen.glow, weight, albedo);
        return;
    }
    const Shade shade = lights_.shade(albedo, crossing.normal, scale(ray.direction, -1));
    seen.shade = {scale(shade.ambient, weight), scale(shade.key, weight)};
}

void Tracer::look_around(const Ray& ray, const Crossing& crossing, std::uint32_t seed, std::uint32_t sample, Seen& seen) const {
    const Vec3 point = along(along(ray.origin, crossing.t, ray.direction), lift_, crossing.face_normal);
    double open = 0;
    for (int i = 0; i < kSkyRays; ++i) {
        const Vec3 direction = to_sky(crossing.normal, sample_2d(seed, kSkyRays * sample + i));
        if (dot(direction, crossing.face_normal) <= 0 || !opaque_.blocked({point, direction}, 0, kReach)) open += 1.0 / kSkyRays;
    }
    seen.open_sky = open;
    const Vec3 key = lights_.to_key(sample_2d(seed ^ 0xa511e9b3U, sample));
    seen.open_key = dot(key, crossing.normal) > 0 && opaque_.blocked({point, key}, 0, INFINITY) ? 0 : 1;
    if (medium_) seen.open_key *= medium_->lit(along(point, 2 * lift_, crossing.normal));
}

}  // namespace isoatlas
