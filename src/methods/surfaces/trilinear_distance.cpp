#include "isoatlas/trilinear_distance.h"

#include <algorithm>
#include <cmath>

#include "base/cancel.h"
#include "base/parallel.h"
#include "field/volume_view.h"
#include "field/voxel_positions.h"
#include "isoatlas/environment.h"
#include "isoatlas/error.h"
#include "methods/surfaces/level_set.h"
#include "methods/surfaces/point_distances.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kBetweenLooks = 1 << 12;  // triangles, until somebody may have cancelled

void require(const TrilinearDistanceOptions& options, double tau) {
    require_isovalue(tau);
    if (!(options.error > 0 && options.max_distance > 0 && options.max_parts > 0))
        throw Error(ErrorKind::usage, {.where = "distance to the trilinear surface", .expected = "error, distance and parts above 0"});
}

/// Weighted sums over the samples of a part: added in the order of the parts, whichever thread measured them.
struct Sums {
    double weight = 0, first = 0, square = 0, max = 0;
    std::int64_t samples = 0;

    void add(double distance, double by) {
        weight += by, first += by * distance, square += by * distance * distance;
        max = std::max(max, distance), ++samples;
    }
};

SurfaceDistance summary(std::span<const Sums> parts, double area_of_a_unit) {
    Sums all;
    for (const Sums& part : parts) {
        all.weight += part.weight, all.first += part.first, all.square += part.square;
        all.max = std::max(all.max, part.max), all.samples += part.samples;
    }
    if (!(all.weight > 0)) return {0, 0, all.max, all.samples, 0};
    return {all.first / all.weight, std::sqrt(all.square / all.weight), all.max, all.samples, all.weight * area_of_a_unit};
}

/// Every so many-th of `count` parts is measured.
std::int64_t step_between(std::int64_t count, const TrilinearDistanceOptions& options) {
    return (count + options.max_parts - 1) / options.max_parts;
}

/// measure(part) of every step-th part of `count`.
template <class Measure>
SurfaceDistance measured(std::int64_t count, bool has_area, const TrilinearDistanceOptions& options, const Context& context,
                         const Measure& measure) {
    const std::int64_t step = step_between(count, options);
    if (count == 0) return {};
    std::vector<Sums> parts(static_cast<std::size_t>((count + step - 1) / step));
    constexpr std::int64_t kBlock = 256;
    for_each_block(context.threads, (std::ssize(parts) + kBlock - 1) / kBlock, [&](std::int64_t block) {
        stop_if_cancelled(context);
        const std::int64_t end = std::min((block + 1) * kBlock, std::ssize(parts));
        for (std::int64_t i = block * kBlock; i < end; ++i) parts[static_cast<std::size_t>(i)] = measure(i * step);
    });
    return summary(parts, has_area ? static_cast<double>(step) : 0);
}

Vec3 mean_of(std::initializer_list<Vec3> points) {
    Vec3 sum{};
    for (const Vec3& point : points) {
        for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += point[axis] / static_cast<double>(points.size());
    }
    return sum;
}

/// The rule that is exact for cubic functions on a triangle.
template <class Distance>
Sums of_triangle(const Corners3& t, const Distance& distance) {
    const double area = area_of(t);
    Sums sums;
    for (std::size_t i = 0; i < 3; ++i) {
        sums.add(distance(t[i]), area / 20);
        sums.add(distance(mean_of({t[i], t[(i + 1) % 3]})), area * 2 / 15);
    }
    sums.add(distance(mean_of({t[0], t[1], t[2]})), area * 9 / 20);
    return sums;
}

/// In voxel coordinates; a point of a cloud is a triangle without extent.
Corners3 part_of(const Extraction& result, const VoxelPositions& positions, std::int64_t part) {
    if (result.surface.triangles.empty()) {
        const Vec3 point = positions.of(result.points.points[static_cast<std::size_t>(part)]);
        return {point, point, point};
    }
    const auto& t = result.surface.triangles[static_cast<std::size_t>(part)];
    const auto at = [&](std::int64_t point) { return positions.of(result.surface.points[static_cast<std::size_t>(point)]); };
    return {at(t[0]), at(t[1]), at(t[2])};
}
std::int64_t parts_of(const Extraction& result) {
    return result.surface.triangles.empty() ? std::ssize(result.points.points) : std::ssize(result.surface.triangles);
}

/// Four lines along each axis through a cell; where a line meets the level set. Lines along an axis meet an area as often as they see of
/// it, so a crossing stands for the area of a line over the sum of the normal's components.
template <class Distance>
Sums of_cell(const LevelBox& box, const Distance& distance) {
    Sums sums;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (int line = 0; line < 4; ++line) {
            Vec3 part{};
            part[(axis + 1) % 3] = (line & 1) != 0 ? 0.75 : 0.25, part[(axis + 2) % 3] = (line >> 1) != 0 ? 0.75 : 0.25;
            const double first = box.value_at(part);
            part[axis] = 1;
            const double last = box.value_at(part);
            if ((first < 0) == (last < 0)) continue;
            part[axis] = first / (first - last);
            double normal = 0, along = 0;
            for (std::size_t other = 0; other < 3; ++other) {
                Vec3 from = part, to = part;
                from[other] = 0, to[other] = 1;
                const double slope = std::abs(box.value_at(to) - box.value_at(from));
                normal = std::hypot(normal, slope), along += slope;
            }
            sums.add(distance({box.from[0] + part[0], box.from[1] + part[1], box.from[2] + part[2]}), normal / along / 4);
        }
    }
    return sums;
}

}  // namespace

SurfaceDistance distance_to_trilinear(const Extraction& result, const Volume& volume, double tau, const TrilinearDistanceOptions& options,
                                      const Context& context) {
    const EnvironmentScope scope(context);
    require(options, tau);
    const VoxelPositions positions(volume.info.geometry);
    const bool has_area = !result.surface.triangles.empty();
    return visit_samples(volume, [&]<class T>(std::span<const T> samples) {
        const LevelSet<T> level_set(volume.info.extent, samples, tau);
        const auto distance = [&](const Vec3& point) { return level_set.distance(point, options.error, options.max_distance); };
        return measured(parts_of(result), has_area, options, context, [&](std::int64_t part) {
            const Corners3 corners = part_of(result, positions, part);
            if (has_area) return of_triangle(corners, distance);
            Sums sums;
            sums.add(distance(corners[0]), 1);
            return sums;
        });
    });
}

SurfaceDistance distance_from_trilinear(const Extraction& result, const Volume& volume, double tau, const TrilinearDistanceOptions& options,
                                        const Context& context) {
    const EnvironmentScope scope(context);
    require(options, tau);
    const VoxelPositions positions(volume.info.geometry);
    return visit_samples(volume, [&]<class T>(std::span<const T> samples) {
        const LevelSet<T> level_set(volume.info.extent, samples, tau);
        const Index3 cells = level_set.cells();
        std::vector<Index3> active;
        for (std::int64_t z = 0; z < cells[2]; ++z) {
            stop_if_cancelled(context);
            for (std::int64_t y = 0; y < cells[1]; ++y) {
                for (std::int64_t x = 0; x < cells[0]; ++x) {
                    if (level_set.box({x, y, z}).is_crossed()) active.push_back({x, y, z});
                }
            }
        }
        const std::int64_t step = step_between(std::ssize(active), options);
        const auto each_cell = [&](const auto& visit) {
            for (std::size_t i = 0; i < active.size(); i += static_cast<std::size_t>(step)) visit(level_set.box(active[i]));
        };
        std::vector<Vec3> points;  // the cells are sampled twice, in the same order: for their points, and with the distances of these
        each_cell([&](const LevelBox& box) {
            (void)of_cell(box, [&](const Vec3& point) {
                points.push_back(point);
                return 0.0;
            });
        });
        PointDistances distances(points, options.max_distance);
        for (std::int64_t part = 0; part < parts_of(result); ++part) {
            if (part % kBetweenLooks == 0) stop_if_cancelled(context);
            distances.add(part_of(result, positions, part));
        }
        std::vector<Sums> parts;
        std::size_t next = 0;
        each_cell([&](const LevelBox& box) { parts.push_back(of_cell(box, [&](const Vec3&) { return distances[next++]; })); });
        return active.empty() ? SurfaceDistance{} : summary(parts, static_cast<double>(step));
    });
}

}  // namespace isoatlas
