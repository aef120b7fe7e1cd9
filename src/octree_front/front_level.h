// extract_front() of classified samples.
#pragma once

#include "isoatlas/octree_front.h"
#include "levelset/tau_level.h"

namespace isoatlas {

/// Throws Error: usage, unsupported.
void require_front(const VolumeInfo& info, const FrontOptions& options, const SurfaceOptions& surface);

/// options: as require_front() wants them; places are those of the level's part of the volume. cells: receives the number of active cells,
/// unless it is null.
[[nodiscard]] FrontSurface extract_front_level(const TauLevel& level, const FrontOptions& options, const ExtractOptions& how,
                                               const Context& context, std::int64_t* cells = nullptr);

}  // namespace isoatlas
