// Decoded length of a strip of a TIFF file, for codes without a checksum: libtiff stops when it has enough bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace isoatlas {

/// PackBits: the bytes of all runs; a truncated last run counts with its available bytes.
[[nodiscard]] std::int64_t packbits_bytes(std::span<const std::byte> strip);

/// LZW (TIFF 6.0, high bits first): the bytes up to the end code, or up to the last whole code. nullopt for invalid codes and for the older
/// form (low bits first).
[[nodiscard]] std::optional<std::int64_t> lzw_bytes(std::span<const std::byte> strip);

}  // namespace isoatlas
