#include "formats/volume/tiff_lengths.h"

#include <algorithm>
#include <array>

namespace isoatlas {

std::int64_t packbits_bytes(std::span<const std::byte> strip) {
    std::int64_t bytes = 0;
    for (std::size_t at = 0; at < strip.size();) {
        const int count = static_cast<signed char>(strip[at++]);
        if (count == -128) continue;  // no operation
        const std::size_t there = strip.size() - at;
        if (count >= 0) {
            const std::size_t run = std::min<std::size_t>(static_cast<std::size_t>(count) + 1, there);
            bytes += static_cast<std::int64_t>(run);
            at += run;
        } else if (there > 0) {
            bytes += 1 - count;
            ++at;
        }
    }
    return bytes;
}

std::optional<std::int64_t> lzw_bytes(std::span<const std::byte> strip) {
    constexpr std::uint32_t kClear = 256, kEnd = 257, kFirst = 258, kCodes = 4096;
    if (strip.size() >= 2 && strip[0] == std::byte{0} && (strip[1] & std::byte{1}) != std::byte{0}) return std::nullopt;
    std::array<std::int64_t, kCodes> length{};  // of the expansion of a code
    std::fill_n(length.begin(), 256, 1);
    std::int64_t bytes = 0, before = 0;  // before: length of the last code; 0: none since the table was cleared
    std::uint32_t next = kFirst, width = 9, bits = 0;
    std::uint64_t buffer = 0;
    for (const std::byte byte : strip) {
        buffer = buffer << 8 | std::to_integer<std::uint64_t>(byte);
        bits += 8;
        if (bits < width) continue;
        bits -= width;
        const auto code = static_cast<std::uint32_t>(buffer >> bits & ((1U << width) - 1));
        if (code == kEnd) return bytes;
        if (code == kClear) {
            next = kFirst;
            width = 9;
            before = 0;
            continue;
        }
        const bool is_new = code == next && before > 0;
        if ((code >= next && !is_new) || next >= kCodes) return std::nullopt;
        if (before > 0) length[next++] = before + 1;  // the new code: the last one and a byte
        before = length[code];
        bytes += before;
        if (next + 1 >= 1U << width && width < 12) ++width;  // "early change": the width grows one code early
    }
    return bytes;
}

}  // namespace isoatlas
