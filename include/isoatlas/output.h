// Writers of everything that is not a surface: the criticality tree and label volumes.
#pragma once

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "isoatlas/analysis.h"
#include "isoatlas/cut.h"
#include "isoatlas/volume.h"

namespace isoatlas {

class Sink;

/// Writes unsigned labels (x fastest; 0 = background) with the geometry of the volume; the format follows the name:
/// .nrrd (gzip), .nii, .nii.gz, .tif. The smallest of uint8/uint16/uint32 that holds the largest label is used (NIfTI, TIFF too).
/// Written to a temporary name and renamed. Throws Error: usage (unknown extension), resource.
void write_labels(const std::string& path, const VolumeInfo& info, std::span<const std::uint32_t> labels);

/// The analysis that labels come from, for the header of their file.
struct LabelOrigin {
    Interpolant interpolant;
    double tunnel_height = 0;   ///< of CutOptions or AnalysisOptions: difference of stored values
    std::optional<double> tau;  ///< stored value: objects at tau; none: zones
    bool cavities = false;      ///< cavities at tau
};
/// The same, and the file records the origin of its labels: as key/value pairs in .nrrd, as lines of ImageJ's description in .tif,
/// "isoatlas objects at tau 0.5, trilinear" (seven digits) in NIfTI. `info` is that of the volume: it calibrates the values.
void write_labels(const std::string& path, const VolumeInfo& info, std::span<const std::uint32_t> labels, const LabelOrigin& origin);
/// The same into a sink (isoatlas/sink.h).
void write_labels(Sink& sink, const VolumeInfo& info, std::span<const std::uint32_t> labels, const LabelOrigin& origin);

/// Labels of a cut with Cut::label: an object's position in Cut::objects + 1, the largest is 1; 0: Low. objects: only those that contain
/// these voxels, with the same labels; empty: all. Throws Error{not_found} for a voxel in no object.
[[nodiscard]] std::vector<std::uint32_t> object_labels(const Cut& cut, std::span<const std::int64_t> objects = {});

/// Writes the samples of a volume (negated ones, isoatlas/polarity.h, as they were before): .nrrd (raw), .npy, .raw (name must carry dims
/// and type, or a .json sidecar is written), .mha, .vti, .nii, .nii.gz, .tif.
void write_volume(const std::string& path, const Volume& volume);
/// The same into a sink; of .raw the samples alone.
void write_volume(Sink& sink, const Volume& volume);

/// For users: "faces", "trilinear", "trilinear, tunnel height 0.25" (seven digits; calibrated; unless it is 0).
[[nodiscard]] std::string describe(Interpolant interpolant, double tunnel_height);

enum class TreeDetail : std::uint8_t { events, levels, elements, contours };

struct TreeOutput {
    TreeDetail detail = TreeDetail::events;
    bool all = false;  ///< events as JSON: also what follows from other events (children, tau_low, chi, ...), and genera
};

/// The tree as a file; the format follows the name: .json (docs/schema), .graphml, .csv, .vtu (points and lines, TTK array names).
void write_tree(const std::string& path, const Volume& volume, const Analysis& analysis, const TreeOutput& options = {});
void write_tree(Sink& sink, const Volume& volume, const Analysis& analysis, const TreeOutput& options = {});
/// The same JSON document on a stream.
void write_tree_json(std::ostream& out, const Volume& volume, const Analysis& analysis, const TreeOutput& options = {});

}  // namespace isoatlas
