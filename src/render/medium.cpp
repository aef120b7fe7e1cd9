#include "render/medium.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>

namespace isoatlas {
namespace {

constexpr double kEnough = 0.996;  // opacity for early ray termination
constexpr std::int64_t kMaxGradients = std::int64_t{1} << 20;
constexpr double kMin = 5e-4;  // min opacity of a segment for computing a gradient

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
    const auto refuse = [&](const char* what, const char* next) {
        throw Error(ErrorKind::unsupported, {.file = volume.info.path, .what = what, .next = next});
    };
    if (!volume.info.geometry.coordinates[0].empty())
        refuse("volume rendering does not support rectilinear grids", "draw its surfaces, or resample it to even spacing");
    constexpr std::int64_t kMaxSide = std::int64_t{1} << 24;  // places of samples are in single precision (Trilinear)
    if (std::ranges::max(volume.info.extent.size) > kMaxSide)
        refuse("volume rendering does not support more than 2^24 samples along an axis", "draw a part of it");
    return block_ranges(volume, threads);
}

/// Adds segments, front to back. shade(light, weight, t of its middle) turns the colour of one into its light. False: nothing behind them
/// is seen.
template <class ShadeSegment>
bool absorb(const SegmentEnds& ends, const Transfer& transfer, const ShadeSegment& shade, Gathered& gathered) {
    const auto& t = ends.t;
    SegmentLights lights;
    for (unsigned left = transfer.lights(ends, lights); left != 0; left &= left - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(left));
        const double weight = (1 - gathered.opacity) * lights.opacity[i];
        Vec3 light{lights.colour[i][1], lights.colour[i][2], lights.colour[i][3]};
        shade(light, weight, (t[i] + t[i + 1]) / 2);
        gathered.light = along(gathered.light, weight, light);
        gathered.opacity += weight;
        if (gathered.opacity >= kEnough) return false;
    }
    return true;
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
    step_ = scene.volume.sample_distance * std::min({spacing[0], spacing[1], spacing[2]}) / frame.radius;
    if (lights != nullptr && volume_->info.extent.voxels() <= kMaxGradients) gradients_ = {*volume_, threads};
    if (scene.volume.shadows && lights != nullptr) shadow_ = shadows(solid, threads);
}

Footprint Medium::footprint(const CameraRays& camera) const { return footprint_of(blocks_, volume_->info, camera); }

Vec3 Medium::voxel_direction(const Vec3& way) const {
    const Vec3 physical = scale(way, frame_.radius);
    return {dot(to_voxel_[0], physical), dot(to_voxel_[1], physical), dot(to_voxel_[2], physical)};
}

Vec3 Medium::voxel_of(const Vec3& point) const {
    const Vec3 physical = minus(frame_.outside(point), volume_->info.geometry.origin);
    return {dot(to_voxel_[0], physical), dot(to_voxel_[1], physical), dot(to_voxel_[2], physical)};
}

void Medium::march(const Ray& ray, double begin, double end, double shift, Gathered& gathered) const {
    go(ray, begin, end, shift, lights_, gathered);
}

void Medium::go(const Ray& ray, double begin, double end, double shift, const Lights* lights, Gathered& gathered) const {
    visit_type(volume_->info.type, [&]<class T>(T) { go_through<T>(ray, begin, end, shift, lights, gathered); });
}

Medium::Passage Medium::passage_of(const Ray& ray, double begin, double end) const {
    const Vec3 origin = voxel_of(ray.origin), way = voxel_direction(ray.direction);
    Vec3 high{};
    for (int a = 0; a < 3; ++a) high[a] = static_cast<double>(volume_->info.extent.size[a] - 1);
    const Gap inside = inside_box(origin, way, {0, 0, 0}, high);
    return {origin, way, std::max(begin, inside.begin), std::min(end, inside.end)};
}

template <class T>
void Medium::go_through(const Ray& ray, double begin, double end, double shift, const Lights* lights, Gathered& gathered) const {
    const Passage passage = passage_of(ray, begin, end);
    if (!(passage.begin < passage.end)) return;
    const Trilinear<T> values(*volume_, transfer_.scale());
    const auto view = lights == nullptr ? Lights::GradientView{} : lights->gradient_view(to_voxel_, scale(ray.direction, -1));
    const auto shade_segment = [&](Vec3& light, double weight, double middle) {
        if (lights == nullptr || !(weight > kMin)) return;
        const Vec3 voxel = along(passage.origin, middle, passage.way);
        Vec3 fall;
        if (gradients_.empty())
            values.fall(voxel, fall);
        else
            gradients_.fall(voxel, fall);
        Lights::Parts parts;
        Lights::parts(fall, view, parts);
        const double lit = shadow_.light(voxel), diffuse = parts.ambient + lit * parts.key, highlight = lit * parts.highlight;
        for (double& part : light) part = part * diffuse + highlight;
    };
    walk(values, passage, shift, [&](const SegmentEnds& ends) { return absorb(ends, transfer_, shade_segment, gathered); });
}

template <class T, class Take>
void Medium::walk(const Trilinear<T>& values, const Passage& passage, double shift, const Take& take) const {
    const auto& [origin, way, begin, end] = passage;
    const RaySegments segments{origin, way, step_, std::floor(begin / step_ - shift) + shift, begin, end};
    // Segments are evaluated kLanes at a time, also those that reach into empty blocks: they add nothing. Until `done` all are taken; its
    // place is known unless a leap ends there.
    std::int64_t segment = -1;  // the one that ends at `done`
    double done = begin;
    SegmentEnds ends;
    auto& [t, place, count] = ends;
    bool has_place = false;
    blocks_.walk(origin, way, begin, end, 1e-7 * step_, [&](double from, double to) {
        if (to <= done) return true;
        if (const std::int64_t next = segments.number_at(from); next > segment + 1) {
            segment = next - 1;
            done = segments.end_of(segment), has_place = false;
        }
        while (done < to) {
            const std::size_t known = has_place ? 1 : 0;
            count = kLanes - 1 + known;
            t[0] = done;
            values.places(segments, segment + static_cast<std::int64_t>(known), std::span<double, kLanes>(t.data() + known, kLanes),
                          std::span<float, kLanes>(place.data() + known, kLanes));
            if (!take(ends)) return false;
            segment += static_cast<std::int64_t>(count);
            done = t[count], place[0] = place[count], has_place = true;
        }
        return true;
    });
}

void Medium::visit_matter(const Ray& ray, double begin, double end, double shift,
                          const std::function<bool(const MatterSegment&)>& visit) const {
    const Passage passage = passage_of(ray, begin, end);
    if (!(passage.begin < passage.end)) return;
    const auto take = [&](const SegmentEnds& ends) {
        const auto& [t, place, count] = ends;
        for (std::size_t i = 0; i < count; ++i) {
            const OpticalProperties matter = transfer_.mean(static_cast<double>(place[i]), static_cast<double>(place[i + 1]));
            if (matter.extinction > 0 && t[i] < t[i + 1] && !visit({t[i], t[i + 1], matter})) return false;
        }
        return true;
    };
    visit_type(volume_->info.type, [&]<class T>(T) { walk(Trilinear<T>(*volume_, transfer_.scale()), passage, shift, take); });
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
