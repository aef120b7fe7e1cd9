// A surface as the points of Dividing Cubes: of an object alone, drawn by viewers and pictures. docs/methods.md.
#pragma once

#include "isoatlas/context.h"
#include "isoatlas/samples_wanted.h"
#include "isoatlas/surface.h"
#include "isoatlas/surface_methods.h"
#include "isoatlas/volume.h"

namespace isoatlas {

/// The samples that points_of_surface() needs: around the cells that the surface passes through. info: of the volume it was made from.
[[nodiscard]] SampleBox samples_around(const VolumeInfo& info, const Surface& surface);

/// The points of Dividing Cubes in the cells with a triangle of the surface, at its isovalue; cells that several objects share have the
/// points of all of them. volume: that of the surface, or the part of it that samples_around() names. divisions: small cubes along each
/// axis of a cell, 1 to kMaxDivisions. Throws Error: usage (divisions, a 2D volume), cancelled. Cost: O(triangles log triangles + cells
/// with triangles * divisions^3), one thread.
[[nodiscard]] PointCloud points_of_surface(const Volume& volume, const Surface& surface, int divisions, const Context& context = {});

/// The radius of discs that leave no gaps: of the sphere around a small cube of the largest cell, physical.
[[nodiscard]] double disc_radius(const VolumeInfo& info, int divisions);

/// Each point as a square of two triangles, perpendicular to its normal, as large as a disc of that radius: for what draws triangles alone.
[[nodiscard]] Surface as_squares(const PointCloud& cloud, double radius);

}  // namespace isoatlas
