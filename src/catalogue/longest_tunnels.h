// The significant tunnels of the objects of a page.
#pragma once

#include "catalogue/page_contents.h"

namespace isoatlas {

/// Of a 3D volume, for the branches of the polarity of the atlas that have entries. Cost: find_handles() (isoatlas/handles.h).
void add_tunnels(PageContents& contents, const Atlas& atlas, const Context& context);

}  // namespace isoatlas
