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

/// From samples and slopes to points in `place`, and normals in `slope` if they are wanted but for rare ones. first: voxel of the bundle.
void place_hits(HitBatch<float>& batch, double tau, const PhysicalMap& map, const Vec3& first, bool normals);
void place_hits(HitBatch<double>& batch, double tau, const PhysicalMap& map, const Vec3& first, bool normals);

}  // namespace isoatlas
