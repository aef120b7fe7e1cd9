// The elements of an interpolant: vertices and faces of the oracle's own, body points as the stage critical/ finds them in each cell.
#pragma once

#include "isoatlas/analysis.h"
#include "oracle/oracle.h"

namespace oracle {

/// tunnel_height: of AnalysisOptions.
Elements elements_of(const Grid& grid, isoatlas::Interpolant interpolant, double tunnel_height = 0);

}  // namespace oracle
