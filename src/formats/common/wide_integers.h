// Integers of 64 bits, read as float64: all up to 2^53, and of the larger ones those that float64 has. Others are an error, not rounded.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace isoatlas {

enum class WideInteger : std::uint8_t { none, int64, uint64 };
[[nodiscard]] const char* name_of(WideInteger type);  ///< "int64", "uint64"; none: ""
/// For the notes of a volume.
[[nodiscard]] std::string note_of(WideInteger type);

/// How samples that a file has as integers of 64 bits become float64.
struct WideIntegers {
    WideInteger type = WideInteger::none;  ///< none: samples stay what they are
    std::vector<std::uint64_t> missing{};  ///< integers that become NaN: their bits
};

/// Replaces the bits of each integer by those of the float64 of its value. file: for messages.
/// Throws Error{unsupported} for a value that float64 does not have. O(samples).
void doubles_of_integers(std::span<std::byte> samples, const WideIntegers& stored, const std::string& file);

}  // namespace isoatlas
