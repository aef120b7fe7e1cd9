#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "formats/common/byte_source.h"

namespace isoatlas {

/// The decompressed bytes of a bzip2 stream (also of several in a row) in [offset, offset + length) of a file; length -1: up to its end.
/// Memory: 4 MB. size_bound() is 2^21 times the compressed size: a block of 24 bytes stands for at most 46 MB.
[[nodiscard]] std::unique_ptr<ByteSource> open_bzip2_source(const std::string& path, std::int64_t offset = 0, std::int64_t length = -1);

}  // namespace isoatlas
