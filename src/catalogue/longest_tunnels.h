// The significant tunnels of the objects of a page.
#pragma once

#include "catalogue/page_contents.h"

namespace isoatlas {

/// Of a 3D volume, for the branches that have entries. Cost: find_handles() (isoatlas/handles.h), of both sides at the same time.
void add_tunnels(PageContents& contents, const StoreSides& sides, const Context& context);

}  // namespace isoatlas
