// The criticality tree as arrays of a store, for other programs: isoatlas itself derives it from the elements.
//
//   events/element                per event, descending: its highest critical element, which gives value and place
//   events/parent                 the next event of the same object going down; of the root the root itself
//   events/kind                   uint8: Criticality (isoatlas/analysis.h)
//   events/lows_out, delta_chi    low components that disappear just below, change of the Euler characteristic of the Highs
//   events/sum                    float64: sum of the samples of the zone of the event
//   events/chi, contours, voxels  of the object just below the event: Euler characteristic, contours; voxels of the zone of the event
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace isoatlas {

class Analysis;
class Container;
struct PackedArray;

/// Events are stored of volumes with at most 2^22 critical elements, and at most one for three voxels: so the tree of a CT scan takes its
/// share of 2 bytes a voxel, and noise takes none. Neither depends on the memory budget of the build.
[[nodiscard]] bool stores_events(const Analysis& analysis);

/// analysis: with events and their voxels; it must live until the arrays are packed.
[[nodiscard]] std::vector<PackedArray> event_arrays(const Analysis& analysis);

/// events/sum: sum of the samples of the zone of each event, which hypervolumes are made of. Not in the first stores of version 1.
[[nodiscard]] PackedArray event_sum_array(std::span<const double> sums);

[[nodiscard]] bool has_event_sums(const Container& store);
/// Empty when they are not stored. Throws Error{input} when their number differs from that of events.
[[nodiscard]] std::vector<double> event_sums_of(const Container& store, std::int64_t events);

/// Describes the first difference between the stored events and those of the analysis; "": none. Cost: reads them.
[[nodiscard]] std::string first_wrong_event(const Container& store, const Analysis& analysis);

}  // namespace isoatlas
