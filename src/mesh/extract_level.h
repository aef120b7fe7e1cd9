// What extract() does once the samples are classified.
#pragma once

#include "isoatlas/surface.h"
#include "query/tau_level.h"

namespace isoatlas {

[[nodiscard]] Surface extract_level(const TauLevel& level, const ExtractOptions& options, const Context& context);
/// Into a surface of before, whose memory is used again. cells: receives how many cells the surface passes through, when asked for.
void extract_level(const TauLevel& level, const ExtractOptions& options, const Context& context, Surface& surface,
                   std::int64_t* cells = nullptr);

}  // namespace isoatlas
