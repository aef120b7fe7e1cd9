// What extract() does once the samples are classified.
#pragma once

#include "isoatlas/surface.h"
#include "query/tau_level.h"

namespace isoatlas {

[[nodiscard]] Surface extract_level(const TauLevel& level, const ExtractOptions& options, const Context& context);

}  // namespace isoatlas
