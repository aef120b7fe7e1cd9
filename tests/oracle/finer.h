// What the trilinear interpolant really does: its own samples, so fine that the faces of the grid alone decide.
#pragma once

#include <string>

#include "oracle/oracle.h"

namespace oracle {

/// The trilinear function of a 3D grid with at least two samples an axis, sampled `steps` times finer.
Grid finer(const Grid& grid, Index steps);

/// The same function with a plane of samples through every saddle inside a cell. A cell is trilinear on either side of such a plane, and
/// has its saddles on its border: the faces tell all, however thin a tunnel is.
Grid cut_at_saddles(const Grid& grid);

struct FinerComparison {
    Index isovalues = 0, faces_differ = 0;  ///< at how many the face rule is wrong
    std::string difference;                 ///< the first isovalue where the trilinear analysis is wrong; empty: none
};

/// Objects, Euler numbers, tunnels and cavities of the trilinear analysis of a grid and of the faces of a finer one, at isovalues that are
/// at least gap / 2 away from every critical value of the finer grid.
FinerComparison compare_with_finer(const Grid& grid, const Grid& fine_grid, double gap);

}  // namespace oracle
