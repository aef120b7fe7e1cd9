// What extract() does once the samples are classified.
// In the literature: isosurface extraction (Lorensen, Cline, Marching Cubes, 1987).
#pragma once

#include "isoatlas/surface.h"
#include "levelset/tau_level.h"

namespace isoatlas {

/// Does a surface with these options ask for components and their names?
[[nodiscard]] bool selects_components(const ExtractOptions& options);
[[nodiscard]] inline bool needs_names(const ExtractOptions& options) { return options.ids || selects_components(options); }

[[nodiscard]] Surface extract_level(const TauLevel& level, const ExtractOptions& options, const Context& context);
/// Into a surface of before, whose memory is used again. cells: receives how many cells the surface passes through, when asked for.
void extract_level(const TauLevel& level, const ExtractOptions& options, const Context& context, Surface& surface,
                   std::int64_t* cells = nullptr);

}  // namespace isoatlas
