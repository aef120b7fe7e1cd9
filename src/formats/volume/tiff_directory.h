// The entries of a TIFF directory as they are in the file. libtiff takes what it cannot read of some tags for missing, and missing tags
// for their default: the samples would be others.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/file_system.h"

namespace isoatlas {

struct TiffEntry {
    std::uint16_t tag = 0, type = 0;
    std::uint64_t count = 0;
};

/// The entries of the directory at `offset`; nothing when the file ends inside it or its link to the next one.
[[nodiscard]] std::optional<std::vector<TiffEntry>> read_tiff_entries(File& file, const std::string& path, std::uint64_t offset,
                                                                      bool is_big_tiff, bool big_endian);

/// What is wrong with a directory: types that do not exist, or one of the tags that decide samples and have a default (Compression,
/// FillOrder, Predictor, SampleFormat) with another type, or missing where a tag of its form stands that differs in one bit. Empty:
/// nothing.
[[nodiscard]] std::string doubtful_tag(const std::vector<TiffEntry>& entries);

/// How many offsets of strips or tiles the directory lists; 0: none.
[[nodiscard]] std::uint64_t pieces_listed(const std::vector<TiffEntry>& entries);

}  // namespace isoatlas
