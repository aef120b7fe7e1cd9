// All objects of a store, for selection by a client: /api/branches.
#pragma once

#include <cstdint>
#include <string>

#include "catalogue/page_contents.h"
#include "isoatlas/atlas.h"
#include "server/query_parameters.h"

namespace isoatlas {

/// A request for branches.
struct BranchesWanted {
    Selection selection{};  ///< stored values
    std::int64_t top = 0;   ///< max number of listed branches
};
/// Throws Error{usage} for unknown parameters.
[[nodiscard]] BranchesWanted branches_wanted(QueryParameters& words, const Calibration& calibration);

/// docs/schema/server-branches. number_of_rank: in the table of objects, 0: none. Throws Error{cancelled}. Cost: O(branches), and the
/// events of those that are listed.
[[nodiscard]] std::string branches_json(const Atlas& atlas, const BranchHierarchy& hierarchy, std::span<const std::int64_t> number_of_rank,
                                        const BranchesWanted& wanted, const Context& context);

/// A branch at its largest extent: just above the value at which it merges; the main branch in the middle of its isovalues.
/// Throws Error{not_found}. Cost: O(events of the branch).
[[nodiscard]] PageEntry branch_entry(const Atlas& atlas, const BranchHierarchy& hierarchy, std::int64_t rank);

}  // namespace isoatlas
