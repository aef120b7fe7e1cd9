// The samples of a volume as arrays of a store: volume/data and the index of its bricks.
//
//   volume/data      the consecutive bricks, in file order (brick_grid.h), each encoded by brick_codec.h
//   volume/offset    per brick: its first byte in volume/data
//   volume/bytes     per brick: size; 0: constant
//   volume/low,high  per brick: its extremes, in the type of the samples
//   volume/lowest,highest   per brick: their positions (brick_extremes.h)
//   volume/checksum  per brick: of its bytes
#pragma once

#include <memory>
#include <vector>

#include "field/volume_view.h"
#include "isoatlas/context.h"
#include "store/pack.h"

namespace isoatlas {

/// The arrays of a volume, to be packed in this order. Samples and info must live until then; their numbers live as long as the arrays.
/// heads: the first byte of each brick, as a store has them (brick_heads()); empty: codes are chosen. Cost: two passes over the samples, 30
/// bytes a brick and a few bricks for each thread.
[[nodiscard]] std::vector<PackedArray> brick_arrays(const VolumeView& volume, const Context& context, std::vector<std::uint8_t> heads = {});
/// volume/lowest and volume/highest alone, of negated samples: their ties are not those of the samples. Cost: a pass over the samples.
[[nodiscard]] std::vector<PackedArray> brick_place_arrays(const VolumeView& volume, const Context& context);

}  // namespace isoatlas
