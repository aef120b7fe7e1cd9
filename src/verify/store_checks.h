// Checks of a store against its own samples.
#pragma once

#include <unordered_map>
#include <vector>

#include "isoatlas/atlas.h"
#include "verify/checks.h"

namespace isoatlas {

/// The stored lowest and highest sample of every brick are those of its samples. They alone decide which bricks a query reads, so when they
/// are right the bricks that are read hold every active cell, of every object, at every isovalue. Cost: O(volume).
[[nodiscard]] CheckResult bricks_hold_active_cells(const Atlas& atlas, const Volume& samples);

/// Every number of the stored trees is that of an analysis of the samples. Names array and place of the first that is not.
/// tolerance: of values (saddle_tolerance).
[[nodiscard]] CheckResult stored_tree_equals_analysis(const Analysis& stored, const Analysis& expected, double tolerance = 0);

/// How far the values of a store's saddles may be from the exact ones: 0, but for versions of the store that did not round them once.
[[nodiscard]] double saddle_tolerance(const Atlas& atlas);

/// The stored events, where a store has them, are those that follow from its elements.
[[nodiscard]] CheckResult stored_events_follow_from_elements(const Atlas& atlas, const Analysis& stored);

/// The numbers that a store holds beside its samples and its tree, which queries take as they are: lowest and highest samples of bricks,
/// census, sums of zones, tables of objects and dark objects, their isovalues. They are found again from the samples and the
/// stored tree, or, `anew`, from the samples alone; then the voxels of elements and the arrays of the tree are compared, too. Of a store
/// that another version would have made otherwise (Atlas::has_present_values()) only what has always been the same is compared. Cost: the
/// second half of a build; anew: a build.
[[nodiscard]] CheckResult stored_tables_are_recomputed(const Atlas& atlas, const Volume& samples, bool anew, const Context& context);

/// All points, triangles, normals and ids are the same.
[[nodiscard]] bool are_same(const Surface& p, const Surface& q);

/// A surface taken apart into those of its objects. The surface must outlive it. Cost: that of the surface once, of a part its own size.
class SurfaceParts {
public:
    explicit SurfaceParts(const Surface& surface);
    /// As extract() gives it for that object alone.
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
