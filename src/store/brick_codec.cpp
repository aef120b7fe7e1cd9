#include "store/brick_codec.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <type_traits>

namespace isoatlas::store {
namespace {

template <std::size_t Bytes>
using Unsigned =
    std::conditional_t<Bytes == 1, std::uint8_t,
                       std::conditional_t<Bytes == 2, std::uint16_t, std::conditional_t<Bytes == 4, std::uint32_t, std::uint64_t>>>;

/// An integer of the same order; every bit counts, so -0.0 and 0.0 differ.
template <class T>
Unsigned<sizeof(T)> key_of(T sample) {
    using Key = Unsigned<sizeof(T)>;
    constexpr Key kSign = static_cast<Key>(Key{1} << (8 * sizeof(T) - 1));
    const Key bits = std::bit_cast<Key>(sample);
    if constexpr (std::is_unsigned_v<T>) return bits;
    if constexpr (std::is_integral_v<T>) return static_cast<Key>(bits ^ kSign);
    return bits & kSign ? static_cast<Key>(~bits) : static_cast<Key>(bits | kSign);
}

template <class T>
T sample_of(Unsigned<sizeof(T)> key) {
    using Key = Unsigned<sizeof(T)>;
    constexpr Key kSign = static_cast<Key>(Key{1} << (8 * sizeof(T) - 1));
    if constexpr (std::is_unsigned_v<T>) return key;
    if constexpr (std::is_integral_v<T>) return std::bit_cast<T>(static_cast<Key>(key ^ kSign));
    return std::bit_cast<T>(key & kSign ? static_cast<Key>(key & ~kSign) : static_cast<Key>(~key));
}

/// Bits [first, first + bits) of packed, as far as they are there. bits <= 64.
std::uint64_t bits_at(std::span<const std::byte> packed, std::size_t first, int bits) {
    const std::size_t byte = first / 8;
    const int skip = static_cast<int>(first % 8);
    std::uint64_t low = 0;
    std::memcpy(&low, packed.data() + byte, std::min<std::size_t>(8, packed.size() - byte));
    low >>= skip;
    if (skip + bits > 64 && byte + 8 < packed.size()) low |= static_cast<std::uint64_t>(packed[byte + 8]) << (64 - skip);
    return bits == 64 ? low : low & ((std::uint64_t{1} << bits) - 1);
}

/// The samples that 8 bytes from their first one on contain whole.
template <class T>
std::size_t decode_inner(std::span<const std::byte> packed, Unsigned<sizeof(T)> low, int bits, std::span<T> samples) {
    const std::uint64_t mask = (std::uint64_t{1} << bits) - 1;
    std::size_t i = 0, position = 0;
    for (; i < samples.size() && position / 8 + 8 <= packed.size(); ++i, position += static_cast<std::size_t>(bits)) {
        std::uint64_t word;
        std::memcpy(&word, packed.data() + position / 8, 8);
        samples[i] = sample_of<T>(static_cast<Unsigned<sizeof(T)>>(low + (word >> position % 8 & mask)));
    }
    return i;
}

}  // namespace

template <class T>
std::pair<T, T> extremes_of(std::span<const T> samples) {
    Unsigned<sizeof(T)> low = key_of(samples.front()), high = low;
    for (const T sample : samples) low = std::min(low, key_of(sample)), high = std::max(high, key_of(sample));
    return {sample_of<T>(low), sample_of<T>(high)};
}

template <class T>
int bits_of_range(T low, T high) {
    return static_cast<int>(std::bit_width(static_cast<Unsigned<sizeof(T)>>(key_of(high) - key_of(low))));
}

template <class T>
void encode_brick(std::span<const T> samples, T low, int bits, std::vector<std::byte>& out) {
    const std::size_t begin = out.size();
    out.resize(begin + static_cast<std::size_t>(packed_bytes(static_cast<std::int64_t>(samples.size()), bits)));
    std::size_t position = 8 * begin;
    for (const T sample : samples) {
        std::uint64_t rest = static_cast<Unsigned<sizeof(T)>>(key_of(sample) - key_of(low));
        for (int left = bits; left > 0;) {
            const int skip = static_cast<int>(position % 8), taken = std::min(8 - skip, left);
            out[position / 8] |= static_cast<std::byte>((rest << skip) & 0xff);
            rest >>= taken;
            left -= taken;
            position += static_cast<std::size_t>(taken);
        }
    }
}

template <class T>
void decode_brick(std::span<const std::byte> packed, T low, int bits, std::span<T> samples) {
    const Unsigned<sizeof(T)> base = key_of(low);
    std::size_t i = bits <= 56 ? decode_inner<T>(packed, base, bits, samples) : 0;
    for (; i < samples.size(); ++i) {
        const std::uint64_t above = bits == 0 ? 0 : bits_at(packed, i * static_cast<std::size_t>(bits), bits);
        samples[i] = sample_of<T>(static_cast<Unsigned<sizeof(T)>>(base + above));
    }
}

#define ISOATLAS_INSTANTIATE(T)                                                         \
    template std::pair<T, T> extremes_of<T>(std::span<const T>);                        \
    template int bits_of_range<T>(T, T);                                                \
    template void encode_brick<T>(std::span<const T>, T, int, std::vector<std::byte>&); \
    template void decode_brick<T>(std::span<const std::byte>, T, int, std::span<T>)
ISOATLAS_INSTANTIATE(std::uint8_t);
ISOATLAS_INSTANTIATE(std::int8_t);
ISOATLAS_INSTANTIATE(std::uint16_t);
ISOATLAS_INSTANTIATE(std::int16_t);
ISOATLAS_INSTANTIATE(std::uint32_t);
ISOATLAS_INSTANTIATE(std::int32_t);
ISOATLAS_INSTANTIATE(float);
ISOATLAS_INSTANTIATE(double);
#undef ISOATLAS_INSTANTIATE

}  // namespace isoatlas::store
