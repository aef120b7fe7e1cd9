// The table of significant objects (isoatlas/objects.h) as arrays of a store, and back: nobody should have to analyse the volume again to
// ask which objects are in it.
//
//   objects/id, event, voxels, tunnels, cavities, inside, branch_top      int64, per entry, by rank
//   objects/appears, merges, best_tau, measure, hypervolume, tau_low, tau_high     float64
//   objects/outline, trunk                                     uint8
//   objects/branches, noise                                    one number each
//   dark/...                                                   the table of dark objects
//   dark_isovalues/...                                         theirs
//   isovalues/branch_top, cavity, tau, prominence, reason      int64, int64, float64, float64, uint8, per recommended isovalue
#pragma once

#include <functional>
#include <vector>

#include "isoatlas/cavities.h"
#include "isoatlas/objects.h"
#include "store/container.h"
#include "store/pack.h"

namespace isoatlas {

/// The table is stored when there are at most so many critical elements: ranking takes all trees at once, with random access. The bytes of
/// a store must not depend on the memory it was built in, so their number decides.
inline constexpr std::int64_t kTableElements = std::int64_t{1} << 22;
/// At most so many entries are stored.
inline constexpr std::int64_t kStoredEntries = 1024;

/// table: ranked with the gate and at most kStoredEntries entries. The arrays live on their own.
[[nodiscard]] std::vector<PackedArray> object_arrays(const ObjectTable& table);

[[nodiscard]] bool has_objects(const Container& store);
/// Does a stored table (ObjectTable, CavityTable) list all that pass the gate?
[[nodiscard]] bool is_whole(const auto& stored) { return std::ssize(stored.entries) < kStoredEntries; }
/// Throws Error{input} when it contradicts itself.
[[nodiscard]] ObjectTable objects_of(const Container& store);
/// Does it say where the branches of its entries begin? Not in stores of before.
[[nodiscard]] bool knows_branches(const ObjectTable& table);

/// The table of dark objects, the same way: dark/id, ... as in CavityEntry, dark/branches, noise.
[[nodiscard]] std::vector<PackedArray> cavity_arrays(const CavityTable& table);
[[nodiscard]] bool has_cavities(const Container& store);
/// Without notes. Throws Error{input} when it contradicts itself.
[[nodiscard]] CavityTable cavities_of(const Container& store);

}  // namespace isoatlas
