#include "render/medium.h"

#include <algorithm>
#include <cmath>

namespace isoatlas {
namespace {

constexpr double kEnough = 0.996;  // opacity for early ray termination
constexpr double kMin = 5e-4;      // min opacity of a segment for computing a gradient

/// t at which a ray in sample coordinates is inside the box from low to high.
Gap inside_box(const Vec3& origin, const Vec3& way, const Vec3& low, const Vec3& high) {
    Gap gap{-INFINITY, INFINITY};
    for (int a = 0; a < 3; ++a) {
        if (way[a] == 0) {
            if (origin[a] < low[a] || origin[a] > high[a]) return {};
            continue;
        }
        const double t0 = (low[a] - origin[a]) / way[a], t1 = (high[a] - origin[a]) / way[a];
        gap.begin = std::max(gap.begin, std::min(t0, t1)), gap.end = std::min(gap.end, std::max(t0, t1));
    }
    return gap;
}

Mat3 physical_to_voxel(const Geometry& geometry) {
    Vec3 axis[3];
    for (int a = 0; a < 3; ++a) {
        for (int r = 0; r < 3; ++r) axis[a][r] = geometry.direction[r][a] * geometry.spacing[a];
    }
    const double determinant = dot(axis[0], cross(axis[1], axis[2]));
    return {scale(cross(axis[1], axis[2]), 1 / determinant), scale(cross(axis[2], axis[0]), 1 / determinant),
            scale(cross(axis[0], axis[1]), 1 / determinant)};
}

BlockRanges ranges_of_regular(const Volume& volume, int threads) {
    if (volume.info.geometry.coordinates[0].empty()) return block_ranges(volume, threads);
    throw Error(ErrorKind::unsupported, {.file = volume.info.path,
                                         .what = "volume rendering does not support rectilinear grids",
                                         .next = "draw its surfaces, or resample it to even spacing"});
}

/// A ray in segments that end at multiples of the step plus a shift; the first and the last one are shorter. A segment is evaluated
/// entirely or not at all, so that empty-space skipping, or splitting a ray in empty space, does not change the result.
struct Pieces {
    double step, first;  ///< start of the first one, in steps
    double begin, end;
    [[nodiscard]] double end_of(std::int64_t piece) const {
        return std::clamp((first + static_cast<double>(piece + 1)) * step, begin, end);
    }
    [[nodiscard]] std::int64_t number_at(double t) const { return static_cast<std::int64_t>(t / step - first); }
};

/// 1 - exp(-x) for x >= 0, to 1e-8.
double swallowed(double x) {
    if (x > 0.125) return 1 - std::exp(-x);
    return x * (1 - x / 2 * (1 - x / 3 * (1 - x / 4 * (1 - x / 5))));
}

}  // namespace

Medium::Medium(const Scene& scene, const Frame& frame, const Lights* lights, const RaySurfaces& solid, int threads)
    : Medium(scene, frame, lights, ranges_of_regular(*scene.volume.volume, threads), solid, threads) {}

Medium::Medium(const Scene& scene, const Frame& frame, const Lights* lights, const BlockRanges& blocks, const RaySurfaces& solid,
               int threads)
    : volume_(scene.volume.volume),
      lights_(lights),
      frame_(frame),
      transfer_(scene.volume, frame.radius, scene.volume.range.value_or(blocks.whole())),
      blocks_(blocks, transfer_, threads),
      to_voxel_(physical_to_voxel(volume_->info.geometry)) {
    const Vec3& spacing = volume_->info.geometry.spacing;
    step_ = std::min({spacing[0], spacing[1], spacing[2]}) / frame.radius;
    if (scene.volume.shadows && lights != nullptr) shadow_ = shadows(solid, threads);
}

Vec3 Medium::voxel_direction(const Vec3& way) const {
    const Vec3 physical = scale(way, frame_.radius);
    return {dot(to_voxel_[0], physical), dot(to_voxel_[1], physical), dot(to_voxel_[2], physical)};
}

Vec3 Medium::voxel_of(const Vec3& point) const {
    const Vec3 physical = subtract(frame_.outside(point), volume_->info.geometry.origin);
    return {dot(to_voxel_[0], physical), dot(to_voxel_[1], physical), dot(to_voxel_[2], physical)};
}

template <class T>
Vec3 Medium::shaded(const Trilinear<T>& values, const Lights& lights, const Vec3& colour, const Vec3& voxel, const Vec3& to_eye) const {
    const Vec3 fall = values.fall(voxel);
    Vec3 normal{};  // the gradient is the transpose of to_voxel_ times the differences along the axes
    for (int a = 0; a < 3; ++a) normal = along(normal, fall[a], to_voxel_[a]);
    normal = unit(normal);
    if (length(normal) == 0) return scale(colour, 0.6);
    if (dot(normal, to_eye) < 0) normal = scale(normal, -1);
    const Shade shade = lights.shade(colour, normal, to_eye);
    return along(shade.ambient, shadow_.light(voxel), shade.key);
}

void Medium::march(const Ray& ray, double begin, double end, double shift, Gathered& gathered) const {
    go(ray, begin, end, shift, lights_, gathered);
}

void Medium::go(const Ray& ray, double begin, double end, double shift, const Lights* lights, Gathered& gathered) const {
    visit_type(volume_->info.type, [&]<class T>(T) { go_through<T>(ray, begin, end, shift, lights, gathered); });
}

template <class T>
void Medium::go_through(const Ray& ray, double begin, double end, double shift, const Lights* lights, Gathered& gathered) const {
    const Vec3 origin = voxel_of(ray.origin), way = voxel_direction(ray.direction), to_eye = scale(ray.direction, -1);
    Vec3 high{};
    for (int a = 0; a < 3; ++a) high[a] = static_cast<double>(volume_->info.extent.size[a] - 1);
    const Gap inside = inside_box(origin, way, {0, 0, 0}, high);
    begin = std::max(begin, inside.begin), end = std::min(end, inside.end);
    if (!(begin < end)) return;
    const Trilinear<T> values(*volume_);
    const Pieces pieces{step_, std::floor(begin / step_ - shift) + shift, begin, end};
    const auto place_at = [&](double t) { return transfer_.place(values.value(along(origin, t, way))); };
    std::int64_t piece = -1;
    double t = begin, place = place_at(t);  // end of the evaluated segments
    blocks_.walk(origin, way, begin, end, 1e-7 * step_, [&](double from, double to) {
        if (const std::int64_t next = pieces.number_at(from); next > piece + 1) {
            piece = next - 1;
            t = pieces.end_of(piece), place = place_at(t);
        }
        while (t < to) {
            const double begin_place = place, begin_t = t;
            t = pieces.end_of(++piece), place = place_at(t);
            const OpticalProperties matter = transfer_.mean(begin_place, place);
            if (!(matter.extinction > 0)) continue;
            const double weight = (1 - gathered.opacity) * swallowed(matter.extinction * (t - begin_t));
            Vec3 light = scale(matter.glow, 1 / matter.extinction);
            if (weight > kMin && lights != nullptr) light = shaded(values, *lights, light, along(origin, (begin_t + t) / 2, way), to_eye);
            gathered.light = along(gathered.light, weight, light);
            gathered.opacity += weight;
            if (gathered.opacity >= kEnough) return false;
        }
        return true;
    });
}

ShadowGrid Medium::shadows(const RaySurfaces& solid, int threads) const {
    return {volume_->info.extent,
            [&](const Vec3& voxel) {
                const Vec3 point = frame_.inside(to_physical(volume_->info.geometry, voxel));
                const Ray ray{point, lights_->to_key({0, 0})};
                if (solid.blocked(ray, 2 * step_, INFINITY)) return 0.0;
                Gathered gathered;
                go(ray, 0, INFINITY, 0, nullptr, gathered);  // only absorption counts
                return 1 - gathered.opacity;
            },
            threads};
}

}  // namespace isoatlas
