// Streams bricks of a store without caching them: subsampling and downsampling.
#pragma once

#include <span>

#include "store/brick_reader.h"

namespace isoatlas {

/// Every step-th sample of a box, from its first one on; out: as many, x fastest. box: not empty, inside the volume. step: 1 or more.
/// Throws as BrickReader::read(). Cost: reads the bricks that hold one of them.
template <class T>
void read_samples(const BrickReader<T>& bricks, const Box& box, std::int64_t step, const Context& context, std::span<T> out,
                  IoCounters& counters);

/// Means of cubes of step^3 samples; those at the far ends of the volume are of the samples that are left. out: one for each cube of the
/// volume, x fastest; fills those of one layer of bricks. layer: brick index along z. step: 1, 2, 4 or 8, so that no cube spans two bricks.
/// Throws as BrickReader::read(). Cost: reads the bricks of the layer.
template <class T>
void read_means(const BrickReader<T>& bricks, std::int64_t step, std::int64_t layer, const Context& context, std::span<float> out,
                IoCounters& counters);

/// Number of steps along an axis of `samples` samples.
[[nodiscard]] constexpr std::int64_t steps_along(std::int64_t samples, std::int64_t step) { return (samples + step - 1) / step; }

}  // namespace isoatlas
