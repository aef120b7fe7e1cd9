// The criticality tree as arrays of a store, for those who read it without isoatlas: isoatlas itself makes it from the elements.
//
//   events/element                per event, descending: its highest critical element, which says value and place
//   events/parent                 the next event of the same object going down; of the root the root itself
//   events/kind                   uint8: Criticality (isoatlas/analysis.h)
//   events/lows_out, delta_chi    what happens: low components that leave just below, change of the Euler characteristic of the Highs
//   events/sum                    float64: sum of the samples of the zone of the event
//   events/chi, contours, voxels  of the object just below the event: Euler characteristic, contours; voxels of the zone of the event
#pragma once

#include <span>
#include <string>
#include <vector>

#include "isoatlas/analysis.h"
#include "store/container.h"
#include "store/pack.h"

namespace isoatlas {

/// Events are stored of volumes with at most 2^22 critical elements, and at most one for three voxels: so the tree of a CT scan takes its
/// share of 2 bytes a voxel, and noise takes none. Neither depends on the memory a store is built in.
[[nodiscard]] bool stores_events(const Analysis& analysis);

/// analysis: with events and their voxels; it must live until the arrays are packed.
[[nodiscard]] std::vector<PackedArray> event_arrays(const Analysis& analysis);

/// events/sum: sum of the samples of the zone of each event, which hypervolumes are made of. Not in the first stores of version 1.
[[nodiscard]] PackedArray event_sum_array(std::span<const double> sums);

[[nodiscard]] bool has_event_sums(const Container& store);
/// Nothing when they are not stored. Throws Error{input} when there are not as many as events.
[[nodiscard]] std::vector<double> event_sums_of(const Container& store, std::int64_t events);

/// Says which number of the stored events is not that of the analysis; "" when all are. Cost: reads them.
[[nodiscard]] std::string first_wrong_event(const Container& store, const Analysis& analysis);

}  // namespace isoatlas
