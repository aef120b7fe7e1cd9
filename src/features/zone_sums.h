// Sums over the zones of events: what the hypervolume of branches follows from.
#pragma once

#include "base/id_array.h"

namespace isoatlas {

class Analysis;
struct VolumeView;

/// Over the zone of each event.
struct ZoneSums {
    IdArray<EventId, double> height;
    double lowest = 0;  ///< height of the lowest sample
};

/// Of superlevel sets. analysis: with zones.
[[nodiscard]] ZoneSums sum_zones(const VolumeView& volume, const Analysis& analysis);

}  // namespace isoatlas
