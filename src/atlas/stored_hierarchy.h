// Selections from the stored tables.
#pragma once

#include <optional>

namespace isoatlas {

class Atlas;
class BranchHierarchy;
struct Context;
struct ObjectTable;
struct Selection;

/// Atlas::hierarchy(); nullopt when the store does not record which branches are significant. Cost: reads the trees; all samples, too,
/// where it has no sums of zones, or the grid has uneven steps.
[[nodiscard]] std::optional<BranchHierarchy> stored_hierarchy(const Atlas& atlas, const Context& context);

/// The lines of the complete stored table of the objects that a selection keeps; nullopt when it keeps others too, or cannot be evaluated.
/// The notes are unchanged.
[[nodiscard]] std::optional<ObjectTable> selected_entries(const Atlas& atlas, const ObjectTable& stored, const Selection& selection,
                                                          const Context& context);

}  // namespace isoatlas
