#include "formats/zarr/zarr_array.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "formats/common/half.h"
#include "formats/zarr/zarr_error.h"

namespace isoatlas {
namespace {

/// The bits of a type in the order of this machine.
template <class T>
void put_value(T value, ZarrArray& array) {
    std::memcpy(array.fill.data(), &value, sizeof value);
}

template <class T, class Number>
bool put_integer(Number number, ZarrArray& array) {
    if (!std::in_range<T>(number)) return false;
    put_value(static_cast<T>(number), array);
    return true;
}

template <class Number>
bool put_number(Number number, ZarrArray& array) {
    if (array.type.kind == ZarrType::Kind::boolean) return put_value(static_cast<std::uint8_t>(number != 0 ? 1 : 0), array), true;
    if (array.type.wide == WideInteger::int64) return put_integer<std::int64_t>(number, array);
    if (array.type.wide == WideInteger::uint64) return put_integer<std::uint64_t>(number, array);
    switch (array.type.type) {
        case ValueType::u8: return put_integer<std::uint8_t>(number, array);
        case ValueType::i8: return put_integer<std::int8_t>(number, array);
        case ValueType::u16: return put_integer<std::uint16_t>(number, array);
        case ValueType::i16: return put_integer<std::int16_t>(number, array);
        case ValueType::u32: return put_integer<std::uint32_t>(number, array);
        case ValueType::i32: return put_integer<std::int32_t>(number, array);
        case ValueType::f32: put_value(static_cast<float>(number), array); return true;
        case ValueType::f64: break;
    }
    put_value(static_cast<double>(number), array);
    return true;
}

/// The nearest number of 16 bits in floating point.
double rounded_to_half(double number) {
    constexpr double kLargest = 65520;  // from here on infinite
    if (!std::isfinite(number) || number == 0) return number;
    if (std::abs(number) >= kLargest) return std::copysign(std::numeric_limits<double>::infinity(), number);
    const double step = std::ldexp(1, std::max(std::ilogb(number), -14) - 10);
    return std::nearbyint(number / step) * step;
}

bool put_double(double number, ZarrArray& array) {
    if (array.type.kind == ZarrType::Kind::half) return put_value(static_cast<float>(rounded_to_half(number)), array), true;
    const bool is_integer = !is_floating(array.type.type) || array.type.wide != WideInteger::none;
    if (array.type.type == ValueType::f64 && !is_integer) return put_value(number, array), true;
    if (array.type.type == ValueType::f32) {
        const bool fits = !std::isfinite(number) || std::abs(number) <= static_cast<double>(std::numeric_limits<float>::max());
        if (fits) put_value(static_cast<float>(number), array);
        return fits;
    }
    constexpr double kExact = 9007199254740992;  // 2^53
    return std::trunc(number) == number && std::abs(number) <= kExact && put_number(static_cast<std::int64_t>(number), array);
}

/// "0x7fc00000": the bits of a sample, the highest first.
bool put_bits(std::string_view digits, ZarrArray& array) {
    std::uint64_t bits = 0;
    if (digits.empty() || digits.size() > 2 * array.type.stored_bytes) return false;
    for (const char c : digits) {
        const int digit = c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
        if (digit < 0) return false;
        bits = bits << 4 | static_cast<std::uint64_t>(digit);
    }
    if (array.type.kind == ZarrType::Kind::half) return put_value(float_of_half(static_cast<std::uint16_t>(bits)), array), true;
    if (array.type.type == ValueType::f32) return put_value(static_cast<std::uint32_t>(bits), array), true;
    if (array.type.type == ValueType::f64 && array.type.wide == WideInteger::none) return put_value(bits, array), true;
    return false;
}

bool put_text(const std::string& text, ZarrArray& array) {
    if (text.starts_with("0x")) return put_bits(std::string_view(text).substr(2), array);
    const bool has_no_numbers = !is_floating(array.type.type) || array.type.wide != WideInteger::none;
    if (has_no_numbers) return text.empty() && put_number(0, array);
    if (text == "NaN") return put_double(std::numeric_limits<double>::quiet_NaN(), array);
    if (text == "Infinity") return put_double(std::numeric_limits<double>::infinity(), array);
    return text == "-Infinity" && put_double(-std::numeric_limits<double>::infinity(), array);
}

}  // namespace

void set_fill(const KeyStore& store, const std::string& where, const Json& value, ZarrArray& array) {
    bool fits = false;
    if (value.is_null()) fits = true;
    if (value.is_boolean()) fits = put_number(value.get<bool>() ? 1 : 0, array);
    if (value.is_number_unsigned()) {
        fits = put_number(value.get<std::uint64_t>(), array);
    } else if (value.is_number_integer()) {
        fits = put_number(value.get<std::int64_t>(), array);
    } else if (value.is_number_float()) {
        fits = put_double(value.get<double>(), array);
    }
    if (value.is_string()) fits = put_text(value.get<std::string>(), array);
    if (!fits) bad_zarr(store, where, "is not a value of the type of the samples", std::string("a value of ") + array.type.name());
}

std::int64_t ZarrArray::chunk_samples() const {
    std::int64_t samples = 1;
    for (const std::int64_t size : chunk) samples *= size;
    return samples;
}

std::string ZarrArray::key(std::span<const std::int64_t> index) const {
    std::string name = keys_begin_with_c ? "c" : "";
    for (const std::int64_t number : index) {
        if (!name.empty()) name += separator;
        name += std::to_string(number);
    }
    return join_key(path, name);
}

void check_array(const KeyStore& store, const std::string& key, const ZarrArray& array) {
    if (array.chunk.size() != array.shape.size() || (array.shards && array.shards->size.size() != array.shape.size()))
        bad_zarr(store, key, "shape and chunks have different numbers of axes", "one size for each axis");
    constexpr std::int64_t kMost = std::int64_t{1} << 50;
    std::int64_t samples = 1, chunks = 1;
    for (std::size_t axis = 0; axis < array.rank(); ++axis) {
        if (array.chunk[axis] > kMost / samples) bad_zarr(store, key, "a chunk has more than 2^50 samples", "chunks that memory can hold");
        samples *= array.chunk[axis];
        if (!array.shards) continue;
        if (array.shards->size[axis] % array.chunk[axis] != 0)
            bad_zarr(store, key, "the shards do not consist of whole chunks", "multiples of the size of a chunk");
        const std::int64_t in_shard = array.shards->size[axis] / array.chunk[axis];
        if (in_shard > kMost / chunks) bad_zarr(store, key, "the chunks of a shard are too many", "a list of them that memory can hold");
        chunks *= in_shard;
    }
}

}  // namespace isoatlas
