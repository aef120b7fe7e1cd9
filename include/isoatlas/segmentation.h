// Segmentations: label volumes with what each label is, as other programs read them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "isoatlas/volume.h"

namespace isoatlas {

class Sink;

/// What a label is.
struct Segment {
    std::int64_t number;  ///< its label
    std::string name;
    std::array<std::uint8_t, 3> colour;
    double isovalue;  ///< reported
    std::int64_t voxels;
};

/// Labels of a volume with what each label is: .seg.nrrd (segments with name, colour, isovalue as Slicer reads them); .nrrd, .nii.gz, ...:
/// labels and beside them a table NAME.csv. labels: per voxel, 0: none, else Segment::number. Returns warnings for the user.
std::vector<std::string> write_segmentation(const std::string& path, std::span<const std::uint32_t> labels,
                                            std::span<const Segment> segments, const VolumeInfo& info);
/// The labels alone into a sink (isoatlas/sink.h), without the table.
std::vector<std::string> write_segmentation(Sink& sink, std::span<const std::uint32_t> labels, std::span<const Segment> segments,
                                            const VolumeInfo& info);

}  // namespace isoatlas
