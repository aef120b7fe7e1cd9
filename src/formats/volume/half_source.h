// Samples of 16 bits in floating point (binary16 of IEEE 754) as float32, which has all their values.
#pragma once

#include <cstdint>
#include <memory>

#include "formats/common/byte_source.h"

namespace isoatlas {

/// Infinite and not-a-number stay what they are.
[[nodiscard]] float float_of_half(std::uint16_t bits);

/// The payload of `source`, samples of 16 bits, as float32 in the byte order of this machine. Positions and sizes are those of the float32;
/// reads and seeks must be whole samples.
[[nodiscard]] std::unique_ptr<ByteSource> widen_halves(std::unique_ptr<ByteSource> source, bool big_endian);

}  // namespace isoatlas
