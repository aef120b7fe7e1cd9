// Which objects of a table merge into which.
#pragma once

#include <cstdint>
#include <vector>

#include "isoatlas/analysis.h"
#include "isoatlas/objects.h"

namespace isoatlas::page {

/// Per entry the entry (the first one of its branch) whose object goes on where this one ends; -1: it never ends, or goes on as one that is
/// not in the table. Cost: O(entries * depth of the tree).
[[nodiscard]] std::vector<std::int64_t> merge_targets(const ObjectTable& table, const Analysis& analysis);

}  // namespace isoatlas::page
