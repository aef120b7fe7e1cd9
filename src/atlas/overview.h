// What a page tells of the objects of a store, made together: a store of noise keeps little of it, and each part alone would be made of all
// samples once more.
#pragma once

#include "isoatlas/atlas.h"

namespace isoatlas {

struct Overview {
    ObjectTable objects;  ///< all that pass the gate
    CavityTable cavities;
    BranchHierarchy hierarchy;
};

/// Atlas::objects(), dark_objects() and hierarchy(); the trees stay with the atlas. Throws Error: input (damaged), cancelled. Cost: that of
/// hierarchy(), and where the store has no tables ranking both sides.
[[nodiscard]] Overview overview_of(const Atlas& atlas, const Context& context);

}  // namespace isoatlas
