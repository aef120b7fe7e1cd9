// A volume file into memory that the caller chooses, slab by slab, with the policy for missing samples.
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "isoatlas/volume.h"

namespace isoatlas {

/// Gives room for so many bytes; may throw std::bad_alloc.
using Allocate = std::function<std::span<std::byte>(std::size_t bytes)>;

/// Reads all samples to what `allocate` gives. Returns what the volume is now: notes, and another type when a calibration was applied.
/// Throws as load_volume(). Cost: reads the file once; one slab of memory beside the samples at most.
[[nodiscard]] VolumeInfo load_samples(VolumeReader& reader, const MissingPolicy& missing, const Allocate& allocate, const Context& context);

}  // namespace isoatlas
