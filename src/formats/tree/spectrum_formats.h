// The formats behind write_spectrum: one function each.
#pragma once

#include "base/atomic_file.h"
#include "formats/common/json_stream.h"
#include "isoatlas/spectrum.h"

namespace isoatlas {

void write_spectrum(const JsonStream::Sink& sink, const VolumeInfo& info, const Spectrum& spectrum);
// Each writes the whole file and commits.
void write_spectrum_csv(AtomicFile& file, const VolumeInfo& info, const Spectrum& spectrum);
void write_spectrum_svg(AtomicFile& file, const VolumeInfo& info, const Spectrum& spectrum);

}  // namespace isoatlas
