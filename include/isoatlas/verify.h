// Verify: proofs of the guarantees, run on demand. Each guarantee is a named check.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "isoatlas/analysis.h"
#include "isoatlas/atlas.h"
#include "isoatlas/levels.h"
#include "isoatlas/surface.h"
#include "isoatlas/volume.h"

namespace isoatlas {

struct CheckResult {
    std::string name;  ///< "surface_is_closed", "join_tree_is_valid", ...
    bool holds;
    std::string detail;  ///< numbers; for a failure the first violation
};

/// closed, manifold (edges and points), oriented, no zero-area triangles, even Euler numbers.
[[nodiscard]] std::vector<CheckResult> verify_mesh(const Mesh& mesh);

/// The greatest distance of a point of one surface from another surface lies between these.
struct DistanceBounds {
    double lower = 0, upper = 0;
};

struct SimplifiedOptions {
    std::optional<double> max_distance{};  ///< above 0: distance_is_within, in both directions; none: only measured
    bool in_voxels = false;  ///< max_distance counts steps between samples, of uneven axes the smallest, not lengths of the volume
    PointSpace space = PointSpace::lps;  ///< of the points of a mesh that does not say it, as the exact surface would be written
    double tolerance = 0.001;            ///< voxels (of the smallest spacing): how closely distances are enclosed
};

struct SimplifiedReport {
    std::vector<CheckResult> checks;
    std::int64_t exact_triangles = 0, exact_contours = 0, contours = 0, exact_genus = 0;
    std::optional<std::int64_t> genus{};                          ///< of all contours of the mesh together; none: it is no manifold
    bool is_measured = false;                                     ///< false: points that are none leave nothing to measure
    DistanceBounds to_exact{}, from_exact{};                      ///< of mesh from exact surface and back, in the unit of the volume
    DistanceBounds to_exact_in_voxels{}, from_exact_in_voxels{};  ///< the same in steps between samples
};

/// A mesh, of this program or another one, against the exact surface of a volume, which extract() made: what verify_mesh() checks (of an
/// open surface not that it is closed), surface_does_not_cross_itself, contours_are_one_to_one, contours_have_same_genus,
/// contours_are_nested_alike, and with max_distance distance_is_within. Crossings and nesting are decided exactly; distances are enclosed
/// for all points, not only for corners of triangles. Contours are paired by nearness, so that one which moved more than half as far as its
/// neighbour is away may find no partner: then contours_are_one_to_one does not hold. info: of the volume. Throws Error: usage (options),
/// input (the mesh is in another unit of length), cancelled. Cost: some 20 microseconds a triangle of both. The same for any number of
/// threads.
[[nodiscard]] SimplifiedReport verify_simplified(const Mesh& mesh, const Surface& exact, const VolumeInfo& info,
                                                 const SimplifiedOptions& options = {}, const Context& context = {});

struct VerifyOptions {
    int levels = 8;  ///< isovalues to compare at
    Interpolant interpolant = Interpolant::trilinear;
    double tunnel_height = 0;  ///< of AnalysisOptions
};

/// Of a store, which has the interpolant that it was built with.
struct AtlasVerifyOptions {
    int levels = 8;          ///< isovalues to compare at
    bool full = false;       ///< every object at every isovalue, and the tree made anew from the samples
    std::uint64_t seed = 1;  ///< chooses isovalues and objects
    int objects = 3;         ///< to compare at each isovalue, unless full
};

/// Tree invariants, Euler sums, zones partition the voxels; and at some isovalues spread over the range (data values and values
/// between): tree == cut == mesh (components, genus, Euler numbers, closed and manifold).
[[nodiscard]] std::vector<CheckResult> verify_volume(const Volume& volume, const VerifyOptions& options = {}, const Context& context = {});

/// A store against itself and its own samples. Whatever the options: every byte of the file against its checksum; the lowest and highest
/// sample of every brick (they decide which bricks a query reads, at any isovalue); the invariants of the stored tree; every other stored
/// number, found again from the samples and the stored tree: census, sums of zones, the tables of objects. At the lowest and highest sample
/// and at `levels` isovalues drawn with `seed`: the stored tree against the flooded samples, surfaces from the store against those of the
/// samples, proved closed, manifold and of the genus that the tree promises; single objects, drawn too, against their part of the whole
/// surface. full: all objects, zones, and every stored number against a new build from the samples; of a store that does not hold the
/// present values (Atlas::has_present_values()) only what has always been the same. A check that finds the store unreadable fails with what
/// and where. Throws Error: cancelled, resource. Cost: reads the store once; O(volume) time an isovalue.
[[nodiscard]] std::vector<CheckResult> verify_atlas(const Atlas& atlas, const AtlasVerifyOptions& options = {},
                                                    const Context& context = {});

/// Levels of detail against the store that they are of: levels_hold_exact_surfaces (the finest level of each surface has the triangles that
/// extract() makes), levels_keep_topology (up to three coarser levels of each, by verify_simplified(), within their distances);
/// levels_can_be_read fails where the file is damaged. Throws Error: cancelled, resource. Cost: reads the file once; some 40 microseconds a
/// triangle of the exact surfaces and level.
[[nodiscard]] std::vector<CheckResult> verify_levels(const Levels& levels, const Atlas& atlas, const Context& context = {});

}  // namespace isoatlas
