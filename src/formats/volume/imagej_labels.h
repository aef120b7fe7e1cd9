// Labels of images in the private tags 50838 and 50839 of ImageJ.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace isoatlas {

/// counts: the bytes of the header and of each text behind it (tag 50838). texts: all of them (tag 50839). UTF-16 becomes UTF-8; empty
/// where there are no labels, or what is there is not sound. Never throws.
[[nodiscard]] std::vector<std::string> imagej_labels(std::span<const std::uint32_t> counts, std::span<const std::byte> texts,
                                                     bool big_endian);

/// Names of channels: what the labels of the images of each channel, the fastest of the axes of the images, have in common, where all
/// of them are different; else empty ones.
[[nodiscard]] std::vector<std::string> channel_names_of(const std::vector<std::string>& labels, std::int64_t channels);

}  // namespace isoatlas
