// Checks of a store against its own samples.
#pragma once

#include <unordered_map>
#include <vector>

#include "isoatlas/atlas.h"
#include "verify/checks.h"

namespace isoatlas {

/// The stored lowest and highest sample of every brick are those of its samples. They alone determine the bricks that a query reads; if
/// they are correct, these bricks contain every active cell, of every object, at every isovalue. Cost: O(volume).
[[nodiscard]] CheckResult bricks_hold_active_cells(const Atlas& atlas, const Volume& samples);

/// Every number of the stored trees is that of an analysis of the samples. Reports array and index of the first difference.
/// tolerance: of values (saddle_tolerance).
[[nodiscard]] CheckResult stored_tree_equals_analysis(const Analysis& stored, const Analysis& expected, double tolerance = 0);

/// Tolerance of the stored values of saddles: 0, except for versions of the store that did not round them once.
[[nodiscard]] double saddle_tolerance(const Atlas& atlas);

/// The stored events, if any, are those that follow from the elements.
[[nodiscard]] CheckResult stored_events_follow_from_elements(const Atlas& atlas, const Analysis& stored);

/// Derived data of a store that queries use without checking: lowest and highest samples of bricks, census, sums of zones, tables of
/// objects and cavities, their isovalues. They are recomputed from the samples and the stored tree, or, `anew`, from the samples alone;
/// then the voxels of elements and the arrays of the tree are compared too. In stores of earlier rules (Atlas::has_present_values()) only
/// arrays that no version has changed are compared. Cost: the second half of a build; anew: a build.
[[nodiscard]] CheckResult stored_tables_are_recomputed(const Atlas& atlas, const Volume& samples, bool anew, const Context& context);

/// All points, triangles, normals and ids are equal.
[[nodiscard]] bool are_same(const Surface& p, const Surface& q);

/// Splits a surface into those of its objects. The surface must outlive it. Cost: O(surface) once, O(part) for each part.
class SurfaceParts {
public:
    explicit SurfaceParts(const Surface& surface);
    /// Equal to extract() of that object alone.
    [[nodiscard]] Surface of(std::int64_t object) const;

private:
    struct Part {
        std::vector<std::size_t> points, triangles, segments;
    };
    template <class Simplex>
    [[nodiscard]] std::int64_t object_of(const Simplex& simplex) const {
        return surface_.object[static_cast<std::size_t>(simplex[0])];
    }

    const Surface& surface_;
    std::vector<std::int64_t> place_;  ///< per point: within its part
    std::unordered_map<std::int64_t, Part> parts_;
};

}  // namespace isoatlas
