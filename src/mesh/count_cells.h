// Number of active cells of some contours.
#pragma once

#include "isoatlas/surface.h"
#include "levelset/components.h"

namespace isoatlas {

/// Those that one of the chosen contours passes through (all: mesh/extract_level.h). Cost: O(voxels / 64 + active cells).
[[nodiscard]] std::int64_t count_cells(const TauLevel& level, Boundary boundary, const Components& components,
                                       IdSpan<ContourNumber, const std::uint8_t> chosen, const Context& context);

}  // namespace isoatlas
