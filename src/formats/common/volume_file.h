// Writers of volume files: a header made from a VolumeInfo, then samples in pieces.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/byte_sink.h"
#include "isoatlas/sink.h"
#include "isoatlas/volume.h"

namespace isoatlas {

/// Calls put with all samples, in file order and in the byte order of this machine, in pieces of any size.
using SampleFeed = std::function<void(const ByteSink&)>;

enum class Packing : bool { raw, gzip };

/// Names and values for the header of a file, on one line each.
using KeyValues = std::vector<std::pair<std::string, std::string>>;

// Each writes a file of info.extent samples of info.type with the geometry, calibration and description of `info`, as far as the format has
// them. Rectilinear grids become regular ones with the mean spacing; the comment or description names what a format cannot represent.
// Throws Error{resource}.
void write_nrrd(Sink& sink, const VolumeInfo& info, const SampleFeed& samples, Packing packing, const KeyValues& pairs = {});
/// Space RAS (LPS and LAS are converted; NIfTI has no unknown space: the numbers of other spaces are written as they are), an sform always,
/// a qform where the axes are perpendicular, lengths in m, mm or um. NIfTI-2 when sizes (above 32767) or numbers do not fit in NIfTI-1.
void write_nifti(Sink& sink, const VolumeInfo& info, const SampleFeed& samples, Packing packing);
/// One page a slice, deflate, voxel size for ImageJ; BigTIFF when the samples exceed 3.9 GB. Keeps neither origin nor directions.
/// Writes back: the link to a page is set when its place is known.
void write_tiff(Sink& sink, const VolumeInfo& info, const SampleFeed& samples, const KeyValues& pairs = {});
/// Space and unit as field data; keeps no calibration. 2D images have one slice.
void write_vti(Sink& sink, const VolumeInfo& info, const SampleFeed& samples);
void write_metaimage(Sink& sink, const VolumeInfo& info, const SampleFeed& samples);
/// NumPy: shape (z, y, x). Keeps no geometry.
void write_npy(Sink& sink, const VolumeInfo& info, const SampleFeed& samples);
/// MRC: 8 and 16-bit integers (uint8 as uint16) and float32, others: Error{unsupported}. Lengths in angstrom where the unit is known. Keeps
/// axes along X, Y and Z in any order, and oblique ones whose first lies along X and second in the plane of X and Y; no other directions.
void write_mrc(Sink& sink, const VolumeInfo& info, const SampleFeed& samples);
/// Samples alone.
void write_raw(Sink& sink, const SampleFeed& samples);
/// The same as a file. A sidecar PATH.json is written beside it unless the name says dims and type and the geometry is the default one.
/// Throws Error{usage} when the name contradicts dims or type.
void write_raw(const std::string& path, const VolumeInfo& info, const SampleFeed& samples);

/// The geometry without coordinates: rectilinear axes get their mean spacing.
[[nodiscard]] Geometry regular_geometry(const VolumeInfo& info);
[[nodiscard]] bool is_rectilinear(const Geometry& geometry);
/// The same position in another space, "LPS" or "RAS"; unchanged for spaces other than these and "LAS".
[[nodiscard]] Geometry turned_to(Geometry geometry, const std::string& space);
/// "LPS", "RAS" or "LAS": the axes are anatomical.
[[nodiscard]] bool is_anatomical(const std::string& space);
[[nodiscard]] inline bool is_anatomical(const Geometry& geometry) { return is_anatomical(geometry.space); }

}  // namespace isoatlas
