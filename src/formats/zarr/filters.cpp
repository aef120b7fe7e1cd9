#include "formats/zarr/filters.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

namespace isoatlas {
namespace {

std::string too_many(std::size_t most) { return "it stands for more than " + std::to_string(most) + " bytes"; }

/// First all first bytes of the elements, then all second ones, ...; bytes behind the last whole element stay.
void unshuffle(std::span<const std::byte> from, std::size_t element, std::span<std::byte> to) {
    const std::size_t count = from.size() / element;
    for (std::size_t byte = 0; byte < element; ++byte) {
        for (std::size_t i = 0; i < count; ++i) to[i * element + byte] = from[byte * count + i];
    }
    std::copy(from.begin() + static_cast<std::ptrdiff_t>(count * element), from.end(),
              to.begin() + static_cast<std::ptrdiff_t>(count * element));
}

/// The bits of an integer, its sign extended.
std::uint64_t integer_at(const std::byte* place, const CodecNumber& type) {
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < type.bytes; ++i)
        bits = bits << 8 | std::to_integer<std::uint64_t>(place[type.big_endian ? i : type.bytes - 1 - i]);
    const bool is_negative = type.kind == 'i' && type.bytes < 8 && (bits >> (8 * type.bytes - 1) & 1U) != 0;
    return is_negative ? bits | ~std::uint64_t{0} << 8 * type.bytes : bits;
}

void store_integer(std::byte* place, const CodecNumber& type, std::uint64_t bits) {
    for (std::size_t i = 0; i < type.bytes; ++i) place[type.big_endian ? type.bytes - 1 - i : i] = static_cast<std::byte>(bits >> 8 * i);
}

template <class T>
T float_at(const std::byte* place, bool big_endian) {
    std::array<std::byte, sizeof(T)> raw{};
    std::copy_n(place, sizeof(T), raw.begin());
    if (big_endian != (std::endian::native == std::endian::big)) std::ranges::reverse(raw);
    return std::bit_cast<T>(raw);
}

template <class T>
void store_float(std::byte* place, bool big_endian, T value) {
    auto raw = std::bit_cast<std::array<std::byte, sizeof(T)>>(value);
    if (big_endian != (std::endian::native == std::endian::big)) std::ranges::reverse(raw);
    std::copy(raw.begin(), raw.end(), place);
}

template <class T>
void sum_floats(const ByteCodec& codec, std::span<const std::byte> from, std::span<std::byte> to) {
    T sum = 0;
    for (std::size_t at = 0; at < from.size(); at += sizeof(T)) {
        const T step = float_at<T>(from.data() + at, codec.encoded.big_endian);
        sum = at == 0 ? step : sum + step;
        store_float(to.data() + at, codec.decoded.big_endian, sum);
    }
}

/// The first value, then differences.
void undo_delta(const ByteCodec& codec, std::span<const std::byte> from, std::span<std::byte> to) {
    if (codec.decoded.kind == 'f')
        return codec.decoded.bytes == 4 ? sum_floats<float>(codec, from, to) : sum_floats<double>(codec, from, to);
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < from.size() / codec.encoded.bytes; ++i) {
        sum += integer_at(from.data() + i * codec.encoded.bytes, codec.encoded);
        store_integer(to.data() + i * codec.decoded.bytes, codec.decoded, sum);
    }
}

double number_at(const std::byte* place, const CodecNumber& type) {
    if (type.kind == 'f') return type.bytes == 4 ? float_at<float>(place, type.big_endian) : float_at<double>(place, type.big_endian);
    const std::uint64_t bits = integer_at(place, type);
    return type.kind == 'i' ? static_cast<double>(static_cast<std::int64_t>(bits)) : static_cast<double>(bits);
}

/// Truncated as numpy does; what does not fit becomes 0.
void store_number(std::byte* place, const CodecNumber& type, double value) {
    if (type.kind == 'f' && type.bytes == 4) return store_float(place, type.big_endian, static_cast<float>(value));
    if (type.kind == 'f') return store_float(place, type.big_endian, value);
    constexpr double kLimit = 9.2e18;
    const bool fits = value > -kLimit && value < kLimit;
    store_integer(place, type, fits ? static_cast<std::uint64_t>(static_cast<std::int64_t>(value)) : 0);
}

void undo_scale(const ByteCodec& codec, std::span<const std::byte> from, std::span<std::byte> to) {
    for (std::size_t i = 0; i < from.size() / codec.encoded.bytes; ++i) {
        const double value = number_at(from.data() + i * codec.encoded.bytes, codec.encoded);
        store_number(to.data() + i * codec.decoded.bytes, codec.decoded, value / codec.scale + codec.offset);
    }
}

}  // namespace

std::string undo_filter(const ByteCodec& codec, std::span<const std::byte> encoded, std::size_t most, std::vector<std::byte>& out) {
    if (codec.kind == ByteCodec::Kind::shuffle) {
        if (encoded.size() > most) return too_many(most);
        out.resize(encoded.size());
        unshuffle(encoded, codec.element, out);
        return "";
    }
    if (encoded.size() % codec.encoded.bytes != 0) return "it does not hold whole numbers";
    const std::size_t count = encoded.size() / codec.encoded.bytes;
    if (count > most / codec.decoded.bytes) return too_many(most);
    out.resize(count * codec.decoded.bytes);
    codec.kind == ByteCodec::Kind::delta ? undo_delta(codec, encoded, out) : undo_scale(codec, encoded, out);
    return "";
}

}  // namespace isoatlas
