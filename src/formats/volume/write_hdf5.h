// Volumes and labels as HDF5.
#pragma once

#include "formats/common/volume_file.h"

namespace isoatlas {

/// An array /volume of chunks of 64^3 samples, shuffled and deflated, with geometry, calibration, unit and description as attributes
/// (docs/formats.md); 2D: chunks of 512^2. Writes back. Memory: a layer of chunks. Throws Error{resource}.
void write_hdf5(Sink& sink, const VolumeInfo& info, const SampleFeed& samples);
/// An array /labels, with the pairs as attributes.
void write_hdf5_labels(Sink& sink, const VolumeInfo& info, const SampleFeed& samples, const KeyValues& pairs);

}  // namespace isoatlas
