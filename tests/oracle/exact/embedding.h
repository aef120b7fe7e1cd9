// Is every surface of a volume what it promises to be? Closed, oriented, a manifold, without flat triangles and coincident points, without
// crossings (exactly), of the contours and genera of cut and tree; and still so in the files of float32.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "isoatlas/surface.h"
#include "isoatlas/volume.h"

namespace oracle {

/// How much was looked at, so that a test can say what its silence is worth.
struct EmbeddingTally {
    std::int64_t meshes = 0, triangles = 0, pairs = 0;
    std::int64_t rounded_meshes = 0, rounded_pairs = 0;    ///< to float32, most triangles read back from STL
    std::int64_t kept_double = 0;                          ///< meshes for which float32 is too coarse: PLY keeps float64
    std::int64_t oblique_meshes = 0, oblique_crossed = 0;  ///< rounded ones whose axes are not those of space; how many cross
    std::array<std::int64_t, 6> tunnels{};                 ///< open ones of each shape, per volume and isovalue
    double shortest_edge = 1e300, min_height = 1e300;      ///< of the triangles, in voxels
    [[nodiscard]] std::string text() const;
};

/// voxel: positions in voxels. spaced: unequal spacing, away from the origin, along the axes of space. oblique: that and sheared.
enum class Placement { own, voxel, spaced, oblique };

/// Extracts the surfaces of both styles, closed and open, writes them and reads them back. The first fault; empty: there is none.
std::string embedding_fault(isoatlas::Volume volume, const std::vector<double>& isovalues, const std::vector<Placement>& placements,
                            EmbeddingTally& tally);

/// ISOATLAS_TRIALS in parts of its usual value: how often a test repeats itself with other numbers.
int repetitions();

}  // namespace oracle
