// Stable isovalues of an object: where its volume changes least (docs/theory/7-which-objects-matter.md#stable-isovalues).
//
// q(tau) = -d ln V / d tau for the volume V(tau) of the object. A minimum of q is a steep boundary of a compact body (by the coarea formula
// q is area / volume times the mean of 1/gradient); it counts when -ln q has a prominence of at least ln 1.5 and the
// voxels that join there are fewer by more than chance.
//
// In the literature: maximally stable extremal regions, MSER (Matas, Chum, Urban, Pajdla 2002), of one branch.
#pragma once

#include <span>
#include <vector>

#include "features/branch_histogram.h"

namespace isoatlas {

/// Bins that the smoothing takes together: isovalues closer than that are not distinguished.
inline constexpr double kSmoothedBins = 7.1;

struct StableIsovalue {
    double tau;
    double prominence;  ///< of -ln q; infinity for the highest peak
    double volume;      ///< V there
    bool at_low_end;    ///< within two bins of the low end of the range
};

/// added[i]: voxels that join the object in bin i of (low, high], bins of equal width from low to high; V(tau at the low edge of bin i) =
/// sum of added[i..]. Returns peaks by descending prominence, possibly none.
std::vector<StableIsovalue> stable_isovalues(std::span<const double> added, double low, double high);
/// The same of a branch; q is the rate along its axis, tau a height.
std::vector<StableIsovalue> stable_isovalues(const BranchHistogram& histogram);

}  // namespace isoatlas
