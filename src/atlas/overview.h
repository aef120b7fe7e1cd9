// Objects, cavities and hierarchy of a store, computed together: stores of noise keep little of it, and each part alone would reread all
// samples.
#pragma once

#include <cstdint>
#include <optional>

#include "isoatlas/cavities.h"
#include "isoatlas/objects.h"
#include "isoatlas/simplify.h"

namespace isoatlas {

class Atlas;

struct Overview {
    ObjectTable objects;  ///< all entries above the gate
    CavityTable cavities;
    BranchHierarchy hierarchy;
};

/// Atlas::objects(), cavities() and hierarchy(); the trees stay with the atlas. Throws Error: input (damaged), cancelled. Cost: that of
/// hierarchy(), and where the store has no tables ranking both sides.
[[nodiscard]] Overview overview_of(const Atlas& atlas, const Context& context);

/// Atlas::objects() of at most kStoredEntries (atlas/object_arrays.h), without the trees; nullopt: the store has no table. Throws
/// Error{input} (damaged).
[[nodiscard]] std::optional<ObjectTable> stored_objects(const Atlas& atlas, std::int64_t top, const Context& context);

}  // namespace isoatlas
