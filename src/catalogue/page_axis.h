// The isovalue axis of a page.
#pragma once

#include "field/axis_scale.h"
#include "isoatlas/atlas.h"

namespace isoatlas {

/// axis_scale() of all samples. Cost: Atlas::histogram().
[[nodiscard]] AxisScale page_axis(const Atlas& atlas, const Context& context = {});

}  // namespace isoatlas
