// The isovalue axis of a page.
#pragma once

#include <span>
#include <vector>

#include "field/axis_scale.h"
#include "isoatlas/atlas.h"
#include "isoatlas/bounds.h"

namespace isoatlas {

/// How many samples are at least each value. Cost: the census of the store; no sample is read.
[[nodiscard]] std::vector<Bounds> samples_of_at_least(const Atlas& atlas, std::span<const double> values);

/// axis_scale() of all samples. Cost: the census of the store; Atlas::histogram() where that leaves it open.
[[nodiscard]] AxisScale page_axis(const Atlas& atlas, const Context& context = {});

}  // namespace isoatlas
