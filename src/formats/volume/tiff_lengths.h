// How many bytes a strip of a TIFF file decodes to, for the codes without a checksum: libtiff stops when it has enough.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace isoatlas {

/// PackBits: the bytes that all runs stand for; a last run that is cut counts with what is there.
[[nodiscard]] std::int64_t packbits_bytes(std::span<const std::byte> strip);

/// LZW (TIFF 6.0, high bits first): the bytes up to the end code, or up to the last whole code. Nothing for codes that make no sense and
/// for the older form (low bits first).
[[nodiscard]] std::optional<std::int64_t> lzw_bytes(std::span<const std::byte> strip);

}  // namespace isoatlas
