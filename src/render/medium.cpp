#include "render/medium.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "render/colours.h"

namespace isoatlas::render {
namespace {

constexpr std::int64_t kBlock = 8;   // samples along a side of a block that is leapt over when nothing in it is visible
constexpr double kEnough = 0.996;    // opacity behind which nothing is seen
constexpr double kLeast = 5e-4;      // opacity of a step that is worth a gradient
constexpr std::int64_t kShadow = 4;  // samples between two points of the grid of shadows

template <class T>
double interpolated(const Volume& volume, const Vec3& voxel) {
    const Extent& extent = volume.info.extent;
    const T* samples = volume.samples<T>().data();
    std::int64_t i[3], step[3] = {1, extent.size[0], extent.slice()};
    double f[3];
    for (int a = 0; a < 3; ++a) {
        const double x = std::clamp(voxel[a], 0.0, static_cast<double>(extent.size[a] - 1));
        i[a] = std::min(static_cast<std::int64_t>(x), std::max<std::int64_t>(0, extent.size[a] - 2));
        f[a] = x - static_cast<double>(i[a]);
        if (extent.size[a] == 1) step[a] = 0;
    }
    const T* s = samples + extent.index(i[0], i[1], i[2]);
    const auto row = [&](const T* p) {
        return static_cast<double>(p[0]) + f[0] * (static_cast<double>(p[step[0]]) - static_cast<double>(p[0]));
    };
    const auto plane = [&](const T* p) {
        const double low = row(p);
        return low + f[1] * (row(p + step[1]) - low);
    };
    const double low = plane(s);
    return low + f[2] * (plane(s + step[2]) - low);
}

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

std::array<double, 2> range_of(const Volume& volume) {
    return visit_samples(volume, [](auto samples) {
        const auto [low, high] = std::minmax_element(samples.begin(), samples.end());
        return std::array<double, 2>{static_cast<double>(*low), static_cast<double>(*high)};
    });
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

}  // namespace

Medium::Medium(const Scene& scene, const Frame& frame, const Lights* lights, const RaySurfaces& solid, int threads)
    : volume_(scene.volume.volume),
      lights_(lights),
      frame_(frame),
      transfer_(scene.volume.bumps, frame.radius, range_of(*volume_)),
      value_at_(visit_type(volume_->info.type, []<class T>(T) { return &interpolated<T>; })),
      to_voxel_(physical_to_voxel(volume_->info.geometry)) {
    const Geometry& geometry = volume_->info.geometry;
    if (!geometry.coordinates[0].empty()) {
        throw Error(ErrorKind::unsupported, {.file = volume_->info.path,
                                             .what = "a rectilinear grid cannot be drawn as matter",
                                             .next = "draw its surfaces, or give it even spacing"});
    }
    step_ = std::min({geometry.spacing[0], geometry.spacing[1], geometry.spacing[2]}) / frame.radius;
    find_visible_blocks(threads);
    if (scene.volume.shadows && lights != nullptr) find_shadows(solid, threads);
}

Vec3 Medium::voxel_direction(const Vec3& way) const {
    const Vec3 physical = scale(way, frame_.radius);
    return {dot(to_voxel_[0], physical), dot(to_voxel_[1], physical), dot(to_voxel_[2], physical)};
}

Vec3 Medium::voxel_of(const Vec3& point) const {
    const Vec3 physical = subtract(frame_.outside(point), volume_->info.geometry.origin);
    return {dot(to_voxel_[0], physical), dot(to_voxel_[1], physical), dot(to_voxel_[2], physical)};
}

Vec3 Medium::slope_at(const Vec3& voxel) const {
    Vec3 slope{};  // the gradient is the transpose of to_voxel_ times the differences along the axes
    for (int a = 0; a < 3; ++a) {
        Vec3 before = voxel, after = voxel;
        before[a] -= 1, after[a] += 1;
        slope = along(slope, value_at(before) - value_at(after), to_voxel_[a]);
    }
    return unit(slope);
}

Vec3 Medium::shaded(const Matter& matter, const Vec3& voxel, const Ray& ray) const {
    const Vec3 colour = scale(matter.glow, 1 / matter.extinction);
    if (lights_ == nullptr) return colour;
    const Vec3 to_eye = scale(ray.direction, -1);
    Vec3 normal = slope_at(voxel);
    if (length(normal) == 0) return scale(colour, 0.6);
    if (dot(normal, to_eye) < 0) normal = scale(normal, -1);
    const Shade shade = lights_->shade(colour, normal, to_eye);
    const Vec3 point = scale(subtract(to_physical(volume_->info.geometry, voxel), frame_.centre), 1 / frame_.radius);
    return along(shade.ambient, lit(point), shade.key);
}

Medium::BlockAhead Medium::block_ahead(const Vec3& voxel, const Vec3& way) const {
    std::int64_t index = 0;
    double exit = INFINITY;
    for (int a = 2; a >= 0; --a) {
        const std::int64_t block =
            std::clamp(static_cast<std::int64_t>(std::floor(voxel[a])) / kBlock, std::int64_t{0}, blocks_.count[a] - 1);
        index = index * blocks_.count[a] + block;
        if (way[a] == 0) continue;
        const auto end = static_cast<double>(kBlock * (way[a] > 0 ? block + 1 : block));
        exit = std::min(exit, std::max(0.0, (end - voxel[a]) / way[a]));
    }
    return {blocks_.visible[index] != 0, exit};
}

void Medium::march(const Ray& ray, double begin, double end, double shift, Gathered& gathered) const {
    const Vec3 origin = voxel_of(ray.origin), way = voxel_direction(ray.direction);
    Vec3 high{};
    for (int a = 0; a < 3; ++a) high[a] = static_cast<double>(volume_->info.extent.size[a] - 1);
    const Gap inside = inside_box(origin, way, {0, 0, 0}, high);
    begin = std::max(begin, inside.begin), end = std::min(end, inside.end);
    // Steps end at whole numbers of steps along the ray, plus the shift: the same ones however a ray is cut into pieces.
    double t = begin, known_until = begin, value = 0;
    bool known = false;
    while (t < end && gathered.opacity < kEnough) {
        if (t >= known_until) {
            const BlockAhead block = block_ahead(along(origin, t + 1e-7 * step_, way), way);
            known_until = t + std::max(block.length, 1e-3 * step_);
            if (!block.visible) {
                t = known_until, known = false;
                continue;
            }
        }
        const double next = std::min(end, (std::floor(t / step_ - shift + 1e-9) + 1 + shift) * step_);
        if (!known) value = value_at(along(origin, t, way));
        const double value_next = value_at(along(origin, next, way));
        const Matter matter = transfer_.mean(value, value_next);
        if (matter.extinction > 0) {
            const double weight = (1 - gathered.opacity) * (1 - std::exp(-matter.extinction * (next - t)));
            const Vec3 middle = along(origin, (t + next) / 2, way);
            const Vec3 light = weight > kLeast ? shaded(matter, middle, ray) : scale(matter.glow, 1 / matter.extinction);
            gathered.light = along(gathered.light, weight, light);
            gathered.opacity += weight;
        }
        value = value_next, known = true;
        t = next;
    }
}

void Medium::find_visible_blocks(int threads) {
    const Extent& extent = volume_->info.extent;
    for (int a = 0; a < 3; ++a) blocks_.count[a] = std::max<std::int64_t>(1, (extent.size[a] - 1 + kBlock - 1) / kBlock);
    const std::int64_t layer = blocks_.count[0] * blocks_.count[1];
    blocks_.visible.assign(layer * blocks_.count[2], 0);
    const auto last = [&](std::int64_t block, int a) { return std::min(extent.size[a] - 1, (block + 1) * kBlock); };
    visit_samples(*volume_, [&](auto samples) {
        for_each_block(threads, static_cast<std::int64_t>(blocks_.visible.size()), [&](std::int64_t i) {
            const std::int64_t x = i % blocks_.count[0], y = i / blocks_.count[0] % blocks_.count[1], z = i / layer;
            auto low = samples[extent.index(x * kBlock, y * kBlock, z * kBlock)], high = low;
            for (std::int64_t w = z * kBlock; w <= last(z, 2); ++w) {
                for (std::int64_t v = y * kBlock; v <= last(y, 1); ++v) {
                    for (std::int64_t u = x * kBlock; u <= last(x, 0); ++u) {
                        const auto s = samples[extent.index(u, v, w)];
                        low = std::min(low, s), high = std::max(high, s);
                    }
                }
            }
            blocks_.visible[i] = transfer_.visible(static_cast<double>(low), static_cast<double>(high)) ? 1 : 0;
        });
    });
}

void Medium::find_shadows(const RaySurfaces& solid, int threads) {
    const Extent& extent = volume_->info.extent;
    for (int a = 0; a < 3; ++a) shadow_count_[a] = (extent.size[a] - 1) / kShadow + 2;
    const std::int64_t layer = shadow_count_[0] * shadow_count_[1];
    std::vector<float> shadow(layer * shadow_count_[2]);
    const Lights* lights = lights_;
    lights_ = nullptr;  // only what is swallowed counts
    for_each_block(threads, layer * shadow_count_[2] / shadow_count_[0], [&](std::int64_t row) {
        for (std::int64_t x = 0; x < shadow_count_[0]; ++x) {
            const std::int64_t i = row * shadow_count_[0] + x;
            const std::int64_t y = row % shadow_count_[1], z = row / shadow_count_[1];
            Vec3 voxel{static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
            for (int a = 0; a < 3; ++a) voxel[a] = std::min(voxel[a] * kShadow, static_cast<double>(extent.size[a] - 1));
            const Vec3 point = scale(subtract(to_physical(volume_->info.geometry, voxel), frame_.centre), 1 / frame_.radius);
            const Ray ray{point, lights->to_key({0, 0})};
            if (solid.blocked(ray, 2 * step_, INFINITY)) continue;
            Gathered gathered;
            march(ray, 2 * step_, INFINITY, 0, gathered);
            shadow[i] = static_cast<float>(1 - gathered.opacity);
        }
    });
    lights_ = lights;
    shadow_ = std::move(shadow);
}

double Medium::lit(const Vec3& point) const {
    if (shadow_.empty()) return 1;
    const Vec3 voxel = voxel_of(point);
    std::int64_t i[3];
    double f[3];
    for (int a = 0; a < 3; ++a) {
        const double x = std::clamp(voxel[a] / kShadow, 0.0, static_cast<double>(shadow_count_[a] - 1) - 1e-6);
        i[a] = std::min(static_cast<std::int64_t>(x), shadow_count_[a] - 2);
        f[a] = x - static_cast<double>(i[a]);
    }
    double sum = 0;
    for (int c = 0; c < 8; ++c) {
        const std::int64_t at = (i[0] + (c & 1)) + shadow_count_[0] * ((i[1] + (c >> 1 & 1)) + shadow_count_[1] * (i[2] + (c >> 2)));
        sum += ((c & 1) != 0 ? f[0] : 1 - f[0]) * ((c & 2) != 0 ? f[1] : 1 - f[1]) * ((c & 4) != 0 ? f[2] : 1 - f[2]) * shadow_[at];
    }
    return sum;
}

}  // namespace isoatlas::render
