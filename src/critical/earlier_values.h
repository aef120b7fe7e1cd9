// Values of saddles as isoatlas computed them until version 2 of the store, with other rounding errors.
//
// Stores of these versions whose values are recomputed from the samples (atlas/element_arrays.h) are in the order of these values.
#pragma once

#include "critical/bodies.h"

namespace isoatlas {

/// (ac - bd) / (a + c - b - d) in doubles, kept between the highest Low and the lowest High.
double earlier_face_value(double a, double b, double c, double d, Diagonal highs);

/// Fills in ambiguous faces and body points of a cell from its corners.
CellBodies earlier_bodies(CellElements& cell, double tunnel_height);

}  // namespace isoatlas
