// Byte run-length coding of Amira (HxByteRLE): a count below 128 and the byte that is repeated, or 128 + count and that many bytes.
#pragma once

#include <memory>

#include "formats/common/byte_source.h"

namespace isoatlas {

/// The bytes that all of `packed` (with random access) stands for. Forwards only: seeking backwards restarts. Memory: a fixed buffer.
[[nodiscard]] std::unique_ptr<ByteSource> open_byte_rle_source(std::unique_ptr<ByteSource> packed);

}  // namespace isoatlas
