// Converts axes of headers (vectors, lengths, angles) to Geometry.
#pragma once

#include <string>
#include <vector>

#include "isoatlas/volume.h"

namespace isoatlas {

/// Gives an axis a step vector: spacing = its length, direction column = its unit vector (also for negative lengths: the column flips).
/// A vector that is zero or not finite keeps spacing 1 and the unit vector, and adds a note.
void set_axis_step(VolumeInfo& info, int axis, const Vec3& step);
/// Spacing along an axis whose direction is already set: a negative one flips the direction, 0 or a non-finite one counts as 1 with a note.
void set_axis_spacing(VolumeInfo& info, int axis, double spacing);
/// Replaces directions that do not span space (parallel axes) by the unit vectors, with a note. Call when all axes are set.
void require_frame(VolumeInfo& info);
/// Gives axis 2 of a 2D image in 3D space the direction normal to the image.
void complete_normal(Geometry& geometry);
/// Uses a calibration read from a file; a slope of 0 or a non-finite number means none (with a note).
void set_calibration(VolumeInfo& info, double slope, double intercept);

}  // namespace isoatlas
