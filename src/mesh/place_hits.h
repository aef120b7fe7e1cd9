// Points and normals of many hits at once, from the samples at and around the ends of their edges.
#pragma once

#include <array>
#include <cstdint>

#include "mesh/physical_map.h"

namespace isoatlas {

/// Hits keep this distance (in edge lengths) from the voxels, so that points stay apart when tau equals a sample. A power of two.
/// A hit between a voxel and the padding lies this far outside the voxel.
inline constexpr double kHitMargin = 1.0 / 1024;

/// Where the hit lies between two samples a and b, 0..1.
inline double hit_fraction(double a, double b, double tau) {
    double t = (tau - a) / (b - a);
    t = t >= kHitMargin ? t : kHitMargin;  // also where it is not a number
    return t > 1 - kHitMargin ? 1 - kHitMargin : t;
}

/// Edges that are hit.
template <class Real>
struct HitBatch {
    std::size_t count = 0;
    Lanes<std::int32_t> from{};                ///< first end, in a bundle of rows (mesh/bundle_samples.h)
    std::array<std::int32_t, kLanes> axis{};   ///< of the edge
    std::array<std::int64_t, kLanes> point{};  ///< where the hit is written
    bool is_at_end = false;                    ///< does one of them look beyond an end of its row?
    // What follows is computed.
    std::array<double, kLanes> a{}, b{};  ///< samples at the ends of the edge
    Lanes<Real> slope{}, change{};        ///< of the samples at the first end, and what it changes by towards the other one
    Lanes<double> place{};                ///< of the hit
    std::array<bool, kLanes> rare{};      ///< PhysicalMap::to_normals
};

/// From samples and slopes to points in `place`, and normals in `slope` if they are wanted but for rare ones. first: voxel of the bundle.
void place_hits(HitBatch<float>& batch, double tau, const PhysicalMap& map, const Vec3& first, bool normals);
void place_hits(HitBatch<double>& batch, double tau, const PhysicalMap& map, const Vec3& first, bool normals);

}  // namespace isoatlas
