// Selections from what a store holds: no sample is read.
#pragma once

#include <optional>

#include "isoatlas/atlas.h"

namespace isoatlas {

/// Atlas::hierarchy(); nothing when the store does not hold enough for it.
[[nodiscard]] std::optional<BranchHierarchy> stored_hierarchy(const Atlas& atlas);

/// The lines of the stored table, which is whole, of the objects that a selection keeps; nothing when it keeps others too, or is not known.
/// The notes are those of before.
[[nodiscard]] std::optional<ObjectTable> selected_entries(const Atlas& atlas, const ObjectTable& stored, const Selection& selection);

}  // namespace isoatlas
