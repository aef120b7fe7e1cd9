// cut() of classified samples.
#pragma once

#include "isoatlas/cut.h"
#include "levelset/tau_level.h"

namespace isoatlas {

[[nodiscard]] Cut cut_level(const TauLevel& level, const CutOptions& options, const Context& context);

}  // namespace isoatlas
