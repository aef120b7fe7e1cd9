// Number of active cells of a surface.
#pragma once

#include "isoatlas/surface.h"
#include "levelset/components.h"

namespace isoatlas {

/// All active cells; with components, those that one of the chosen contours passes through.
/// Cost: O(voxels / 64), and O(active cells) for chosen contours.
[[nodiscard]] std::int64_t count_cells(const TauLevel& level, Boundary boundary, const Context& context);
[[nodiscard]] std::int64_t count_cells(const TauLevel& level, Boundary boundary, const Components& components,
                                       IdSpan<ContourNumber, const std::uint8_t> chosen, const Context& context);

}  // namespace isoatlas
