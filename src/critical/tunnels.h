// The shapes a tunnel through a cell can have (trilinear.md section 2, "Six tunnel configurations").
#pragma once

namespace isoatlas {

/// Can a tunnel join the regions a and b of a cell, with the region `ring` around it? Regions: bit k for corner k; all other corners belong
/// to other regions. Up to the 48 symmetries of the cube there are six such triples.
bool tunnel_fits(unsigned a, unsigned b, unsigned ring);

}  // namespace isoatlas
