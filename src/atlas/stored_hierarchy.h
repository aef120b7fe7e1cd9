// Selections from what a store holds.
#pragma once

#include <optional>

#include "isoatlas/atlas.h"

namespace isoatlas {

/// Atlas::hierarchy(); nothing when the store does not say which branches are significant. Cost: reads the trees; all samples, too, where
/// it has no sums of zones, or the grid has uneven steps.
[[nodiscard]] std::optional<BranchHierarchy> stored_hierarchy(const Atlas& atlas, const Context& context);

/// The lines of the stored table, which is whole, of the objects that a selection keeps; nothing when it keeps others too, or is not known.
/// The notes are those of before.
[[nodiscard]] std::optional<ObjectTable> selected_entries(const Atlas& atlas, const ObjectTable& stored, const Selection& selection,
                                                          const Context& context);

}  // namespace isoatlas
