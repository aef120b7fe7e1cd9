// The formats behind write_spectrum: one function each.
#pragma once

#include "formats/common/json_stream.h"
#include "isoatlas/spectrum.h"

namespace isoatlas {

// Each writes the whole file.
void write_spectrum_json(const JsonStream::Output& output, const VolumeInfo& info, const Spectrum& spectrum, const SpectrumOutput& options);
void write_spectrum_csv(Sink& sink, const VolumeInfo& info, const Spectrum& spectrum);
void write_spectrum_svg(Sink& sink, const VolumeInfo& info, const Spectrum& spectrum);

}  // namespace isoatlas
