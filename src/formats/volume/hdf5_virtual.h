// Virtual arrays of HDF5, which take their samples of others.
#pragma once

#include "formats/volume/hdf5_object.h"

namespace isoatlas {

/// HDF5 takes for granted that the samples which a virtual array takes of its sources are there, and that it is none of its own sources,
/// directly or through others. Throws Error{input} where that is not so, a file of sources is not there or may not be opened, and where
/// sources of sources go deeper than 8. Cost: opens every source. The caller holds hdf5_mutex().
void check_sources(Hdf5File::Data& data, hid_t array, const std::string& path);

}  // namespace isoatlas
