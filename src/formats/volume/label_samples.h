// Labels as samples of the smallest unsigned type that holds them.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "formats/common/volume_file.h"

namespace isoatlas {

/// uint8, uint16 or uint32.
[[nodiscard]] ValueType label_type(std::span<const std::uint32_t> labels);
/// Of a type that holds them all; in pieces. The labels must outlive the feed.
[[nodiscard]] SampleFeed label_feed(std::span<const std::uint32_t> labels, ValueType type);
/// Throws Error{usage} when the volume has another number of voxels, or no format for labels has this name; Error{unsupported} for
/// labels that the format cannot keep.
void check_labels(const std::string& path, const VolumeInfo& info, std::span<const std::uint32_t> labels);
/// The labels in the format of the name.
void write_label_file(Sink& sink, const VolumeInfo& header, const SampleFeed& feed, const KeyValues& pairs);

}  // namespace isoatlas
