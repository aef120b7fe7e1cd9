// Representatives of the components: the voxels whose indices are their ids (docs/decisions/0001).
#pragma once

#include "levelset/components.h"

namespace isoatlas {

/// Fills highest and lowest of the components. Reads all samples of objects and cavities; where the level has bricks, only at runs in
/// divided bricks whose component might have its extreme there.
void find_representatives(const TauLevel& level, const Context& context, Components& components);

}  // namespace isoatlas
