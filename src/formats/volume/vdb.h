// OpenVDB files, as what reads and writes them sees them; vdb_openvdb.cpp has the library, where the build has it.
#pragma once

#include <string>

#include "formats/common/volume_file.h"

namespace isoatlas {

/// A grid `density` of the samples, to the last bit: float32 (also of integers below 32 bits), float64 (also of uint32) or int32. Samples
/// that equal the value that is most frequent at the border of the volume are the inactive background. Memory: the grid and the file.
/// Throws Error: unsupported{built_without_format}, resource.
void write_vdb(Sink& sink, const VolumeInfo& info, const SampleFeed& samples);
/// A grid `labels` of int32, 0 is the inactive background. Throws as write_vdb(), and Error{unsupported} for labels above 2^31 - 1.
void write_vdb_labels(Sink& sink, const VolumeInfo& info, const SampleFeed& samples);

}  // namespace isoatlas
