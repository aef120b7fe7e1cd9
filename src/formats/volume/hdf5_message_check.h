// Messages in headers of HDF5 objects: HDF5 decodes most of them without a look at where they end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "formats/volume/hdf5_frame.h"

namespace isoatlas {

/// Kinds of messages (HDF5 File Format Specification, version 3.0, section IV.A.2).
enum class Hdf5Message : std::uint8_t {
    space = 1,
    places_of_links = 2,
    type = 3,
    old_fill_value = 4,
    fill_value = 5,
    link = 6,
    external_files = 7,
    layout = 8,
    group = 10,
    filters = 11,
    attribute = 12,
    comment = 13,
    old_time = 14,
    heap_table = 15,
    continuation = 16,
    names_of_links = 17,
    time = 18,
    sizes_of_trees = 19,
    driver = 20,
    places_of_attributes = 21,
    references = 22,
    file_space = 23,
    cache_image = 24,
};

/// What of a message does not lie in it, or of what it refers to in heaps of names; "": nothing, or another function checks the kind
/// (types, attributes, sources of virtual arrays, continuations).
[[nodiscard]] std::string damage_of_hdf5_message(const Hdf5Frame& frame, Hdf5Message kind, std::span<const std::byte> bytes);

/// The address that stands for nowhere.
[[nodiscard]] std::uint64_t hdf5_nowhere(const Hdf5Frame& frame);

/// Dimensions, at most 32, that lie in their message.
[[nodiscard]] bool is_sound_hdf5_space(const Hdf5Frame& frame, std::span<const std::byte> bytes);

}  // namespace isoatlas
