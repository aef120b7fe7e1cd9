// The phases of extract_front(), as its progress reports them.
#pragma once

#include "base/phase.h"

namespace isoatlas {

inline constexpr PhasePlan<5> kFrontPhases{{"classify", "blocks", "leaves", "points", "triangles"}};

}  // namespace isoatlas
