// Base64 text as bytes. Forward only; seeking backwards restarts.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "formats/common/byte_source.h"

namespace isoatlas {

class File;

/// Decodes base64 in the bytes [begin, end) of a file, up to `<` or the end. White space is skipped; padding may stand in the
/// middle (several encodings one after the other). path: for messages. Throws Error{input} at a character that is not base64.
[[nodiscard]] std::unique_ptr<ByteSource> open_base64_source(std::unique_ptr<File> file, const std::string& path, std::int64_t begin,
                                                             std::int64_t end);

}  // namespace isoatlas
