// The table of significant objects (isoatlas/objects.h) as arrays of a store, and back, so that queries need no new analysis.
//
//   objects/id, event, voxels, tunnels, cavities, inside, branch_top      int64, per entry, by rank
//   objects/appears, merges, best_tau, measure, hypervolume, tau_low, tau_high     float64
//   objects/outline, trunk                                     uint8
//   objects/sides, border                                      uint8, float64: ObjectEntry::border; of objects of low values
//   objects/branches, noise                                    one number each
//   dark/...                                                   the table of cavities
//   dark_isovalues/...                                         theirs
//   isovalues/branch_top, cavity, tau, prominence, reason      int64, int64, float64, float64, uint8, per recommended isovalue
#pragma once

#include <cstdint>
#include <iterator>
#include <vector>

#include "isoatlas/polarity.h"

namespace isoatlas {

class Container;
struct CavityTable;
struct ObjectTable;
struct PackedArray;

/// The table is stored for at most this many critical elements: ranking needs all trees in memory, with random access. The bytes
/// of a store must not depend on the memory budget of the build, so the limit is their number.
inline constexpr std::int64_t kTableElements = std::int64_t{1} << 22;
/// Max stored entries.
inline constexpr std::int64_t kStoredEntries = 1024;

/// table: ranked with the gate and at most kStoredEntries entries. The arrays live on their own.
/// polarity: low also stores where objects touch the border.
[[nodiscard]] std::vector<PackedArray> object_arrays(const ObjectTable& table, Polarity polarity);

[[nodiscard]] bool has_objects(const Container& store);
/// Does a stored table (ObjectTable, CavityTable) list all that pass the gate?
[[nodiscard]] bool is_whole(const auto& stored) { return std::ssize(stored.entries) < kStoredEntries; }
/// Throws Error{input} when it contradicts itself.
[[nodiscard]] ObjectTable objects_of(const Container& store);
/// Does it record where the branches of its entries begin? Not in earlier stores.
[[nodiscard]] bool knows_branches(const ObjectTable& table);

/// The table of cavities, likewise: dark/id, ... as in CavityEntry, dark/branches, noise.
[[nodiscard]] std::vector<PackedArray> cavity_arrays(const CavityTable& table);
[[nodiscard]] bool has_cavities(const Container& store);
/// Without notes. Throws Error{input} when it contradicts itself.
[[nodiscard]] CavityTable cavities_of(const Container& store);

}  // namespace isoatlas
