// The list of the entries of a zip archive (APPNOTE.TXT of PKWARE, 4.3.12 to 4.3.16).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/file_system.h"

namespace isoatlas {

struct ZipEntry {
    std::string name;
    std::int64_t offset = 0;  ///< of its local header, inside the file
    std::int64_t packed = 0;  ///< bytes of data
    std::int64_t bytes = 0;   ///< decompressed; at most 1032 times `packed`
    std::uint32_t crc = 0;
    int method = 0;  ///< 0: stored, 8: deflated, others
    bool is_encrypted = false;
};

inline constexpr int kZipStored = 0, kZipDeflated = 8;

/// The entries that are files, by name; of several of one name the last. Throws Error{input} for an archive that is cut off or damaged.
/// Memory: in proportion to the list in the file.
[[nodiscard]] std::vector<ZipEntry> read_zip_directory(File& file, const std::string& path);

/// Where the data of an entry begin. Throws Error{input}.
[[nodiscard]] std::int64_t zip_data_offset(File& file, const std::string& path, const ZipEntry& entry);

}  // namespace isoatlas
