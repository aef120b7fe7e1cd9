// Dividing Cubes (section 3.3): an active cell is divided into small cubes, whose corners get values by trilinear interpolation; cubes with
// Highs and Lows become points, with the gradient interpolated from the samples of the cell.
// In the literature: Cline, Lorensen, Ludke, Crawford, Teeter, Two algorithms for the three-dimensional reconstruction of tomograms, 1988.
#pragma once

#include "isoatlas/surface_methods.h"

namespace isoatlas {

class DividingCubes final : public Extractor {
public:
    /// divisions: 1 to kMaxDivisions.
    DividingCubes(const Volume& volume, int divisions) : volume_(volume), divisions_(divisions) {}
    Extraction extract(double tau, const Context& context) const override;

private:
    const Volume& volume_;
    int divisions_;
};

}  // namespace isoatlas
