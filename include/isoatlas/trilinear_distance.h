// How far the result of a surface method lies from the level set of the trilinear interpolant, and the other way round.
//
// In voxel coordinates, where neighbouring samples are one apart: "0.1 voxels". The level set: where the interpolant equals the isovalue,
// in the volume. docs/methods.md.
#pragma once

#include <cstdint>

#include "isoatlas/context.h"
#include "isoatlas/surface_methods.h"

namespace isoatlas {

/// In voxels, weighted by area in voxel coordinates; points of a cloud count alike.
struct SurfaceDistance {
    double mean = 0, rms = 0;
    double max = 0;  ///< of the samples
    std::int64_t samples = 0;
    double area = 0;  ///< that they stand for, in squares of a voxel's side; 0: of a cloud. Of the level set: an estimate, a few percent
};

struct TrilinearDistanceOptions {
    double error = 0.001;             ///< voxels; a distance is at most this, or a hundredth of itself, more than the true one
    double max_distance = 8;          ///< voxels; what lies farther away counts as this
    std::int64_t max_parts = 10'000;  ///< triangles, points of a cloud, active cells that are looked at: every k-th of more
};

/// From the result to the level set: each triangle at its corners, the middles of its edges and its centre, weighted so that cubic
/// functions have the right mean; each point of a cloud. What is missing does not show. Nothing to measure: 0 samples. tau: that of the
/// result. Throws Error: usage (options out of range, an isovalue that is none), cancelled. Cost: some microseconds a sample where the
/// level set is near.
[[nodiscard]] SurfaceDistance distance_to_trilinear(const Extraction& result, const Volume& volume, double tau,
                                                    const TrilinearDistanceOptions& options = {}, const Context& context = {});

/// From the level set to the result: in each active cell where four lines along each axis meet the level set, exactly; to the nearest point
/// of a triangle, or of a cloud. What is missing shows. Otherwise as distance_to_trilinear().
[[nodiscard]] SurfaceDistance distance_from_trilinear(const Extraction& result, const Volume& volume, double tau,
                                                      const TrilinearDistanceOptions& options = {}, const Context& context = {});

}  // namespace isoatlas
