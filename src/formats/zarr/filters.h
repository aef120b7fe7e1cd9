// The filters of numcodecs that Zarr arrays have beside a compressor.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "formats/zarr/codecs.h"

namespace isoatlas {

/// Undoes a shuffle, a delta or a scale, as decode().
[[nodiscard]] std::string undo_filter(const ByteCodec& codec, std::span<const std::byte> encoded, std::size_t most,
                                      std::vector<std::byte>& out);

}  // namespace isoatlas
