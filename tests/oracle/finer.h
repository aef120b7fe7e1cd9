// What the trilinear interpolant really does: its own samples, so fine that the faces of the grid alone decide.
#pragma once

#include <string>

#include "oracle/oracle.h"

namespace oracle {

/// The trilinear function of a 3D grid with at least two samples an axis, sampled `steps` times finer.
Grid finer(const Grid& grid, Index steps);

struct FinerComparison {
    Index isovalues = 0, faces_differ = 0;  ///< at how many the face rule is wrong
    std::string difference;                 ///< the first isovalue where the trilinear analysis is wrong; empty: none
};

/// Objects, Euler numbers, tunnels and cavities of the trilinear analysis of a grid and of the finer grid, at isovalues that are at least
/// gap / 2 away from every critical value of the finer grid.
FinerComparison compare_with_finer(const Grid& grid, Index steps, double gap);

}  // namespace oracle
