// Loads a volume file into memory of the caller, slab by slab, with the policy for missing samples.
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "isoatlas/volume.h"

namespace isoatlas {

/// Allocates that many bytes; may throw std::bad_alloc.
using Allocate = std::function<std::span<std::byte>(std::size_t bytes)>;

/// Reads all samples into the memory of `allocate`. Returns the description of the volume: with notes, and another type when a calibration
/// was applied.
/// Throws as load_volume(). Cost: reads the file once; at most one slab of memory besides the samples.
[[nodiscard]] VolumeInfo load_samples(VolumeReader& reader, const MissingPolicy& missing, const Allocate& allocate, const Context& context);

}  // namespace isoatlas
