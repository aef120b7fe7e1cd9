// Segmentations: label volumes with what each label is: a number, a name, a colour, the isovalue that it was made at.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "isoatlas/polarity.h"

namespace isoatlas {

class Sink;

struct Segment {
    std::int64_t number;                 ///< its label: 1 to 2^32 - 1
    std::string name;                    ///< UTF-8; empty: "object N"
    std::array<std::uint8_t, 3> colour;  ///< red, green, blue: sRGB
    double isovalue;                     ///< reported
    std::int64_t voxels;
    Polarity polarity = Polarity::high;  ///< low: of a volume that is not negated, an object of low values
};

/// What a file says of one of its labels.
struct NamedLabel {
    std::int64_t label;
    std::string name;                    ///< UTF-8
    std::array<std::uint8_t, 3> colour;  ///< red, green, blue: sRGB
};

/// Of the labels of a file that have a name: .nrrd: its segments, as 3D Slicer and write_segmentation() write them; others: the table
/// NAME.csv beside it that write_segmentation() writes. By label. Empty: there are none, or what says so cannot be read. Cost: a header.
[[nodiscard]] std::vector<NamedLabel> named_labels(const std::string& path);

/// Labels of a volume with what each label is: .seg.nrrd (segments with name, colour, isovalue as 3D Slicer reads them); .nrrd, .nii,
/// .nii.gz, .tif: labels and beside them a table NAME.csv (docs/formats.md#segmentations). labels: per voxel, 0: none, else
/// Segment::number. The smallest unsigned type is used. Returns warnings for the user. Throws Error: usage (unknown extension, wrong number
/// of labels, a label without a segment, numbers that are not from 1 to 2^32 - 1 or not distinct), resource (also: NAME.csv is there and is
/// no such table).
std::vector<std::string> write_segmentation(const std::string& path, std::span<const std::uint32_t> labels,
                                            std::span<const Segment> segments, const VolumeInfo& info);
/// The same into a sink (isoatlas/sink.h); of formats other than .seg.nrrd the labels alone, without a table.
std::vector<std::string> write_segmentation(Sink& sink, std::span<const std::uint32_t> labels, std::span<const Segment> segments,
                                            const VolumeInfo& info);

}  // namespace isoatlas
