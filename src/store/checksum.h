// Every byte of a store lies under a checksum: XXH3, 64 bits, of the library xxHash.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace isoatlas::store {

[[nodiscard]] inline std::uint64_t checksum(std::span<const std::byte> bytes) { return XXH3_64bits(bytes.data(), bytes.size()); }

}  // namespace isoatlas::store
