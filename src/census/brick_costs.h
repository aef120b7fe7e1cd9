// search_costs() without zone files.
#pragma once

#include <vector>

#include "isoatlas/search_table.h"

namespace isoatlas {

/// As search_costs(); zones_loaded, zones_visited: 0. Cost: O(cells): where events are many, counting zone files takes most of the time.
[[nodiscard]] std::vector<SearchCost> brick_costs(const Volume& volume, const Analysis& analysis, const Context& context);

}  // namespace isoatlas
