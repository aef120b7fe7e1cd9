#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "formats/common/byte_source.h"

namespace isoatlas {

/// The decompressed bytes of a bzip2 stream (also of several in a row) in [offset, offset + length) of a file; length -1: up to its end.
/// Memory: 4 MB. size_bound() is 2^21 times the compressed size: a block of 24 bytes stands for at most 46 MB.
[[nodiscard]] std::unique_ptr<ByteSource> open_bzip2_source(const std::string& path, std::int64_t offset = 0, std::int64_t length = -1);
/// The first bytes of what a bzip2 file holds: max of them, or all when it has fewer. Throws Error{input} on a damaged stream.
[[nodiscard]] std::vector<std::byte> read_bunzipped_bytes(const std::string& path, std::int64_t max);

}  // namespace isoatlas
