// A payload of 16-bit floating-point samples, read as float32.
#pragma once

#include <memory>

#include "formats/common/byte_source.h"
#include "formats/common/half.h"

namespace isoatlas {

/// The payload of `source`, samples of 16 bits, as float32 in the byte order of this machine. Positions and sizes are those of the float32;
/// reads and seeks must be whole samples.
[[nodiscard]] std::unique_ptr<ByteSource> widen_halves(std::unique_ptr<ByteSource> source, bool big_endian);

}  // namespace isoatlas
