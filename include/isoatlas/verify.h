// Verify: proofs of the guarantees, run on demand. Each guarantee is a named check.
#pragma once

#include <string>
#include <vector>

#include "isoatlas/analysis.h"
#include "isoatlas/atlas.h"
#include "isoatlas/surface.h"
#include "isoatlas/volume.h"

namespace isoatlas {

struct CheckResult {
    std::string name;  ///< "surface_is_closed", "join_tree_is_valid", ...
    bool holds;
    std::string detail;  ///< numbers; for a failure the first offender
};

/// closed, manifold (edges and points), oriented, no zero-area triangles, even Euler numbers.
[[nodiscard]] std::vector<CheckResult> verify_mesh(const Mesh& mesh);

struct VerifyOptions {
    int levels = 8;  ///< isovalues to compare at
    Interpolant interpolant = Interpolant::trilinear;
    double tunnel_height = 0;  ///< of AnalysisOptions
};

/// Tree invariants, Euler sums, zones partition the voxels; and at some isovalues spread over the range (data values and values
/// between): tree == cut == mesh (components, genus, Euler numbers, closed and manifold).
[[nodiscard]] std::vector<CheckResult> verify_volume(const Volume& volume, const VerifyOptions& options = {}, const Context& context = {});

/// Every checksum of a store; the guarantees of its volume (verify_volume); cuts and surfaces from the store are those of the volume.
[[nodiscard]] std::vector<CheckResult> verify_atlas(const Atlas& atlas, const VerifyOptions& options = {}, const Context& context = {});

}  // namespace isoatlas
