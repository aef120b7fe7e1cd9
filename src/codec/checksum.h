// Checksums of stores: XXH3, 64 bits, of the library xxHash. They cover every byte.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace isoatlas {

[[nodiscard]] inline std::uint64_t checksum(std::span<const std::byte> bytes) { return XXH3_64bits(bytes.data(), bytes.size()); }

/// Incremental checksum.
class Checksum {
public:
    Checksum() { XXH3_64bits_reset(&state_); }
    void add(std::span<const std::byte> bytes) { XXH3_64bits_update(&state_, bytes.data(), bytes.size()); }
    [[nodiscard]] std::uint64_t sum() const { return XXH3_64bits_digest(&state_); }

private:
    XXH3_state_t state_;
};

}  // namespace isoatlas
