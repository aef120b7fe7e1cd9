// Lists of any length, such as texts, lie in heaps of an HDF5 file. HDF5 copies them without a look at their size; they are read here.
#pragma once

#include <cstddef>
#include <vector>

#include "formats/common/hdf5_handle.h"

namespace isoatlas {

/// The bytes of each list of an attribute, `element` bytes for each of its members; empty for a list that is damaged or empty. Empty: the
/// attribute cannot be read. The caller holds hdf5_mutex(), and guarantees that the type of the attribute is a text or a list.
[[nodiscard]] std::vector<std::vector<std::byte>> read_hdf5_lists(hid_t attribute, std::size_t element);

}  // namespace isoatlas
