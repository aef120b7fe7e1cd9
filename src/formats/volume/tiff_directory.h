// The raw entries of a TIFF directory. libtiff treats some unreadable tags as missing, and missing tags as their default, which would
// change the samples.
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

/// The entries of the directory at `offset`; nullopt when the file ends inside it or its link to the next one.
[[nodiscard]] std::optional<std::vector<TiffEntry>> read_tiff_entries(File& file, const std::string& path, std::uint64_t offset,
                                                                      bool is_big_tiff, bool big_endian);

/// Describes the error in a directory: invalid types; one of the tags that decide samples and have a default (Compression, FillOrder,
/// Predictor, SampleFormat, ImageDepth, TileDepth) with another type; or one of the first four missing where a tag of its form stands that
/// differs in one bit. samples: of a pixel, each of which may have a SampleFormat. Empty: no error.
[[nodiscard]] std::string doubtful_tag(const std::vector<TiffEntry>& entries, int samples);

/// Number of offsets of strips or tiles in the directory; 0: none.
[[nodiscard]] std::uint64_t pieces_listed(const std::vector<TiffEntry>& entries);

}  // namespace isoatlas
