// Points and normals of many hits at once, from the samples at and around the ends of their edges.
#pragma once

#include <array>
#include <cstdint>

#include "mesh/hit_batch.h"

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

/// Points of hits along an axis in `place`, from samples. first: voxel of the bundle.
void place_hits(const HitBatch& batch, std::size_t axis, double tau, const PhysicalMap& map, const Vec3& first, HitValues<float>& values);
void place_hits(const HitBatch& batch, std::size_t axis, double tau, const PhysicalMap& map, const Vec3& first, HitValues<double>& values);

/// Normals of placed hits in `slope`, but for degenerate ones. slope and change: differences of samples at the ends of the edges, times
/// scales where all have the same: slopes.
void compute_normals(const HitBatch& batch, const PhysicalMap& map, const std::array<float, 3>& scales, HitValues<float>& values);
void compute_normals(const HitBatch& batch, const PhysicalMap& map, const std::array<double, 3>& scales, HitValues<double>& values);

}  // namespace isoatlas
