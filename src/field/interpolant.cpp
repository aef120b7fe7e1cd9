#include "isoatlas/interpolant.h"

namespace isoatlas {

const char* name_of(Interpolant interpolant) { return interpolant == Interpolant::faces ? "faces" : "trilinear"; }

}  // namespace isoatlas
