// What the probe knows about surfaces with fewer triangles: the first promise that does not hold.
#pragma once

#include <cmath>
#include <random>
#include <set>
#include <string>

#include "isoatlas/cluster_hierarchy.h"
#include "isoatlas/octree_front.h"
#include "oracle/coarse_surfaces.h"

namespace mutants {

/// Samples of few values, so that there are many small contours with tunnels, near each other.
inline isoatlas::Volume rough_volume(std::mt19937& random, isoatlas::Index3 size) {
    const isoatlas::Extent extent{3, size};
    std::vector<float> samples;
    for (std::int64_t i = 0; i < extent.voxels(); ++i) samples.push_back(static_cast<float>(random() % 7));
    return isoatlas::make_volume<float>(extent, samples);
}

inline std::string broken_promise_of(const isoatlas::Volume& volume, double tau, std::mt19937& random) {
    const oracle::Surface exact = isoatlas::extract(volume, tau);
    const isoatlas::Geometry& geometry = volume.info.geometry;
    const auto failure = [&](const oracle::Surface& coarse, double distance) {
        return oracle::coarse_failure(coarse, exact, volume.info, {distance});
    };
    for (const double distance : {0.05, 0.3, 1.0}) {
        const auto simplified = simplify_surface(exact, geometry, volume.info.extent, {.max_distance = distance});
        if (const std::string found = failure(simplified.surface, simplified.distance); !found.empty())
            return "simplified surface: " + found;
    }
    for (const int level : {1, 3}) {
        const isoatlas::FrontSurface front = extract_front(volume, tau, {.max_level = level});
        if (const std::string found = failure(front.surface, oracle::kInfinity); !found.empty()) return "octree front: " + found;
    }
    const auto hierarchy = make_clusters(exact, geometry, volume.info.extent, {.triangles = 12, .clusters = 5});
    for (const isoatlas::ClusterGroup& group : hierarchy.groups) {
        for (const std::int64_t part : group.made_of) {
            const double before = hierarchy.groups[static_cast<std::size_t>(part)].distance;
            if (group.distance <= 2 * before) return "a step of twice the length is not added to those before it";
        }
    }
    for (const unsigned tenths : {10U, 8U}) {
        double distance = 0;
        const oracle::Surface choice = surface_of_choice(hierarchy, [&](std::int64_t group) {
            const bool is_chosen = random() % 10 < tenths;
            if (is_chosen) distance = std::max(distance, hierarchy.groups[static_cast<std::size_t>(group)].distance);
            return is_chosen;
        });
        if (const std::string found = failure(choice, distance); !found.empty()) return "choice of clusters: " + found;
    }
    return {};
}

/// A shape cut down to a size that takes no time.
inline isoatlas::Volume small_volume(oracle::Shape shape, isoatlas::Index3 size) {
    shape.extent.size = size;
    return oracle::volume_of(shape);
}

/// Of more than 64 words.
inline std::string broken_promise_of_long_rows(std::mt19937& random) {
    const isoatlas::Volume volume = rough_volume(random, {4200, 3, 3});
    const isoatlas::FrontSurface front = extract_front(volume, 3.5, {.max_level = 1});
    const bool same = oracle::euler_numbers(front.surface) == oracle::euler_numbers(isoatlas::extract(volume, 3.5));
    return same ? "" : "octree front: long rows have other Euler numbers";
}

/// In place of surfaces of many hits.
inline std::string broken_promise_of_points() {
    for (const oracle::Shape& shape : {oracle::kShapes[4], oracle::kShapes[5]}) {
        const isoatlas::Volume volume = oracle::volume_of(shape);
        const oracle::Surface exact = isoatlas::extract(volume, shape.tau);
        const isoatlas::FrontSurface front = extract_front(volume, shape.tau, {.exact_above = 1, .points = 700});
        const std::set<isoatlas::Vec3> points(front.surface.points.begin(), front.surface.points.end());
        const auto found = std::ranges::count_if(exact.points, [&](const isoatlas::Vec3& point) { return points.contains(point); });
        if (found < 699 || found != std::ssize(points)) return "points in place of a surface: they are others";
    }
    const isoatlas::Volume volume = oracle::volume_of(oracle::kShapes[5]);
    const auto spacing = [&](double share) {
        isoatlas::Volume scaled = volume;
        for (double& step : scaled.info.geometry.spacing) step *= share;
        return extract_front(scaled, oracle::kShapes[5].tau, {.exact_above = 1, .points = 700}).spacing;
    };
    return std::abs(spacing(2) - 2 * spacing(1)) < 1e-3 * spacing(2) ? "" : "points in place of a surface: their area is no area";
}

inline std::string broken_promise_of_coarser_surfaces() {
    std::mt19937 random(20261127);
    if (const std::string found = broken_promise_of_points(); !found.empty()) return found;
    if (const std::string found = broken_promise_of_long_rows(random); !found.empty()) return found;
    for (const isoatlas::Index3 size : {isoatlas::Index3{9, 8, 7}, isoatlas::Index3{5, 12, 6}, isoatlas::Index3{24, 4, 4}}) {
        const std::string found = broken_promise_of(rough_volume(random, size), 3.5, random);
        if (!found.empty()) return found;
    }
    for (const oracle::Shape& shape : oracle::kShapes) {
        const isoatlas::Index3 size{std::min<std::int64_t>(shape.extent.size[0], 22), std::min<std::int64_t>(shape.extent.size[1], 18),
                                    std::min<std::int64_t>(shape.extent.size[2], 9)};
        const std::string found = broken_promise_of(small_volume(shape, size), shape.tau, random);
        if (!found.empty()) return found;
    }
    return {};
}

}  // namespace mutants
