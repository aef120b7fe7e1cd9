// A file that is packed as a whole, by gzip or bzip2: read as what is in it, without a copy on the disk.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "formats/common/byte_source.h"

namespace isoatlas {

enum class FilePacking : std::uint8_t { none, gzip, bzip2 };

/// By the first bytes; ten tell bzip2 from a text that begins like it.
[[nodiscard]] FilePacking packing_of(std::span<const std::byte> first);
[[nodiscard]] FilePacking packing_of(const std::string& path);
/// "raw", "gzip", "bzip2": VolumeInfo::encoding.
[[nodiscard]] const char* name_of(FilePacking packing);

/// "scan.mrc.gz", "scan.mrc.bz2": "scan.mrc"; another name as it is.
[[nodiscard]] std::string_view unpacked_name(std::string_view path);

/// The first bytes of what is in the file: max of them, or all when it has fewer. Throws Error{input}: cannot be read, a damaged stream.
[[nodiscard]] std::vector<std::byte> read_unpacked_bytes(const std::string& path, std::int64_t max);
/// What is in the file, from `offset` on: position 0 is that byte. With random access where it is not packed.
[[nodiscard]] std::unique_ptr<ByteSource> open_unpacked(const std::string& path, std::int64_t offset);

}  // namespace isoatlas
