// HDF5 decodes headers of objects without a look at where their messages end: they are checked before it sees them.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "formats/volume/hdf5_frame.h"

namespace isoatlas {

/// What is damaged in the header of an object: messages that do not lie in it, types, attributes and links that do not fit in their
/// messages, sources of a virtual array that do not fit in their heap; "": nothing. What lies in other heaps is not looked at.
[[nodiscard]] std::string damage_of_hdf5_header(const Hdf5Frame& frame, std::uint64_t address);

/// Whether a description of a type begins the bytes and lies in them.
[[nodiscard]] bool is_sound_hdf5_type(std::span<const std::byte> bytes);
/// Whether the list of sources of a virtual array, an object of the global heap, is whole.
[[nodiscard]] bool is_sound_hdf5_source_list(const Hdf5Frame& frame, std::span<const std::byte> bytes);

}  // namespace isoatlas
