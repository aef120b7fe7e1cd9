// The significant tunnels of the objects of a page.
#pragma once

#include <optional>

#include "catalogue/page_contents.h"
#include "isoatlas/handles.h"

namespace isoatlas {

/// The significant tunnels of both sides; none of a 2D volume.
struct PageTunnels {
    std::optional<FoundHandles> main, low;
};

/// contents: the noise of both sides. Cost: find_handles() (isoatlas/handles.h), of both sides at the same time.
[[nodiscard]] PageTunnels find_tunnels(const PageContents& contents, const StoreSides& sides, const Context& context);
/// To the branches that have entries.
void add_tunnels(PageContents& contents, const StoreSides& sides, const PageTunnels& found);

}  // namespace isoatlas
