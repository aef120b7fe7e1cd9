// Checks of a store against its own samples.
#pragma once

#include "isoatlas/atlas.h"
#include "verify/checks.h"

namespace isoatlas {

/// The stored lowest and highest sample of every brick are those of its samples. They alone decide which bricks a query reads, so when they
/// are right the bricks that are read hold every active cell, of every object, at every isovalue. Cost: O(volume).
[[nodiscard]] CheckResult bricks_hold_active_cells(const Atlas& atlas, const Volume& samples);

/// Every number of the stored trees is that of an analysis of the samples. Names array and place of the first that is not.
[[nodiscard]] CheckResult stored_tree_equals_analysis(const Analysis& stored, const Analysis& expected);

/// The stored events, where a store has them, are those that follow from its elements.
[[nodiscard]] CheckResult stored_events_follow_from_elements(const Atlas& atlas, const Analysis& stored);

/// All points, triangles, normals and ids are the same.
[[nodiscard]] bool are_same(const Surface& p, const Surface& q);

/// The part of a surface that belongs to one object, as extract() gives it for that object alone.
[[nodiscard]] Surface surface_of_object(const Surface& surface, std::int64_t object);

}  // namespace isoatlas
