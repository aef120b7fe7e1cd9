// An event without the index of all events, for callers that look at a few.
#pragma once

#include "analysis/analysis_data.h"

namespace isoatlas {

/// Analysis::event() but for children, objects_in and object_voxels, which stay empty. Throws Error{usage} for an id that is out of range.
/// Cost: O(1).
[[nodiscard]] Event event_alone(const Analysis::Data& data, EventId id);

}  // namespace isoatlas
