#include "codec/brick_codec.h"

#include <algorithm>
#include <array>
#include <concepts>
#include <cstring>

#include "base/check.h"
#include "base/sample_types.h"
#include "codec/bit_groups.h"
#include "codec/float_units.h"
#include "codec/sample_keys.h"
#include "codec/whole_brick.h"

namespace isoatlas {
namespace {

enum class Kind : std::uint8_t { keys = 0, exact_units = 1, units_with_tails = 2, raw = 3 };

/// The first byte of a brick.
struct Head {
    Kind kind = Kind::keys;
    Orders orders{0, 0, 0};

    [[nodiscard]] std::uint8_t byte() const {
        return static_cast<std::uint8_t>(static_cast<int>(kind) << 6 | orders[2] << 4 | orders[1] << 2 | orders[0]);
    }
    static Head of(std::uint8_t byte) { return {static_cast<Kind>(byte >> 6), {byte & 3, byte >> 2 & 3, byte >> 4 & 3}}; }
    [[nodiscard]] bool is_known() const { return kind == Kind::raw ? orders == Orders{0, 0, 0} : std::ranges::max(orders) < 3; }
};

/// Samples are kept as they are where coding saves less than this part of them (docs/decisions/0046-raw-bricks.md).
template <class T>
constexpr std::int64_t kRawWhereLess = std::floating_point<T> ? 4 : 8;
constexpr std::int64_t kFewTailBits = 4;  ///< bits a sample: below this, keys were never better by more than 1 %

/// The numbers of a brick, padded with zeros to whole groups.
template <class N>
struct Numbers {
    std::array<N, kBrickSamples> of;
    std::size_t size, padded;

    explicit Numbers(std::size_t count) : size(count), padded((count + kGroup - 1) / kGroup * kGroup) {
        ISOATLAS_CHECK(count <= of.size());
        std::fill(of.begin() + static_cast<std::ptrdiff_t>(size), of.begin() + static_cast<std::ptrdiff_t>(padded), N{0});
    }
    [[nodiscard]] std::span<N> samples() { return {of.data(), size}; }
    [[nodiscard]] std::span<N> groups() { return {of.data(), padded}; }
};

template <class T>
void fill_keys(std::span<const T> samples, T low, std::span<Key<T>> keys) {
    const Key<T> min = key_of(low);
    std::transform(samples.begin(), samples.end(), keys.begin(), [min](T s) { return static_cast<Key<T>>(key_of(s) - min); });
}

template <class T>
void fill_units(std::span<const T> samples, T low, const Units& units, std::span<Key<T>> numbers) {
    const Key<T> min = in_units(low, units);
    std::transform(samples.begin(), samples.end(), numbers.begin(), [&](T s) { return static_cast<Key<T>>(in_units(s, units) - min); });
}

template <class N>
Numbers<N> arranged(const Numbers<N>& numbers, const Index3& size, const Orders& orders) {
    Numbers<N> differences(numbers), result(numbers.size);
    take_differences<N>(differences.samples(), size, orders);
    arrange<N>(differences.samples(), size, orders, result.samples());
    return result;
}

template <class N>
BrickCode cost(const Numbers<N>& numbers, const Index3& size, const Head& head) {
    return {head.byte(), 1 + group_bytes<N>(arranged(numbers, size, head.orders).groups())};
}

/// Chooses the best order of differences for each axis in turn.
template <class N>
BrickCode best_orders(const Numbers<N>& numbers, const Index3& size, Kind kind) {
    Head head{kind, {1, 1, 1}};
    BrickCode best = cost(numbers, size, head);
    for (int axis = 2; axis >= 0; --axis) {
        for (const int order : {2, 0}) {
            head = Head::of(best.head);
            if (order == 0 && head.orders[axis] == 2) continue;  // both rough and smooth?
            head.orders[axis] = order;
            const BrickCode code = cost(numbers, size, head);
            if (code.bytes < best.bytes) best = code;
        }
    }
    return best;
}

template <class T>
BrickCode best_in_units(std::span<const T> samples, const Index3& size, T low, const Units& units, std::int64_t tails) {
    Numbers<Key<T>> numbers(samples.size());
    fill_units(samples, low, units, numbers.samples());
    BrickCode code = best_orders(numbers, size, units.exact ? Kind::exact_units : Kind::units_with_tails);
    code.bytes += 2 + (tails + 7) / 8;
    return code;
}

template <class T>
BrickCode best_of_keys(std::span<const T> samples, const Index3& size, T low) {
    Numbers<Key<T>> numbers(samples.size());
    fill_keys(samples, low, numbers.samples());
    return best_orders(numbers, size, Kind::keys);
}

template <class T>
BrickCode best_coded(std::span<const T> samples, const Index3& size, T low) {
    if constexpr (std::floating_point<T>) {
        if (const std::optional<Units> units = units_of(samples)) {
            const std::int64_t tails = units->exact ? 0 : tail_bits(samples, *units);
            const BrickCode code = best_in_units(samples, size, low, *units, tails);
            if (tails <= kFewTailBits * static_cast<std::int64_t>(samples.size())) return code;
            const BrickCode keys = best_of_keys(samples, size, low);
            return code.bytes < keys.bytes ? code : keys;
        }
    }
    return best_of_keys(samples, size, low);
}

void append_exponent(int exponent, std::vector<std::byte>& out) {
    out.push_back(static_cast<std::byte>(exponent & 0xff));
    out.push_back(static_cast<std::byte>(exponent >> 8 & 0xff));
}

int take_exponent(std::span<const std::byte>& packed) {
    const int bits = static_cast<int>(packed[0]) | static_cast<int>(packed[1]) << 8;
    packed = packed.subspan(2);
    return bits >= 1 << 15 ? bits - (1 << 16) : bits;
}

template <class N>
bool take_numbers(std::span<const std::byte>& packed, const Index3& size, const Orders& orders, N low, Numbers<N>& numbers) {
    Numbers<N> stored(numbers.size);
    if (!unpack_groups<N>(packed, stored.groups())) return false;
    if (size == kBrickSize) {
        restore_whole_brick<N>(stored.samples(), orders, numbers.samples());
    } else {
        disarrange<N>(stored.samples(), size, orders, numbers.samples());
        undo_differences<N>(numbers.samples(), size, orders);
    }
    for (N& number : numbers.samples()) number = static_cast<N>(number + low);
    return true;
}

template <std::floating_point T>
bool decode_units(std::span<const std::byte> packed, const Index3& size, T low, const Head& head, std::span<T> samples) {
    if (packed.size() < 2) return false;
    const Units units{take_exponent(packed), head.kind == Kind::exact_units};
    Numbers<Key<T>> numbers(samples.size());
    if (!take_numbers(packed, size, head.orders, in_units(low, units), numbers)) return false;
    if (!units.exact) return join_tails<T>(numbers.samples(), packed, units, samples);
    from_units<T>(numbers.samples(), units, samples);
    return packed.empty();
}

template <class T>
bool decode_keys(std::span<const std::byte> packed, const Index3& size, T low, const Head& head, std::span<T> samples) {
    Numbers<Key<T>> numbers(samples.size());
    if (!take_numbers(packed, size, head.orders, key_of(low), numbers)) return false;
    const std::span<const Key<T>> keys = numbers.samples();
    std::transform(keys.begin(), keys.end(), samples.begin(), sample_of<T>);
    return packed.empty();
}

}  // namespace

template <class T>
std::pair<T, T> extremes_of(std::span<const T> samples) {
    Key<T> low = key_of(samples.front()), high = low;
    for (const T sample : samples) low = std::min(low, key_of(sample)), high = std::max(high, key_of(sample));
    return {sample_of<T>(low), sample_of<T>(high)};
}

template <class T>
BrickCode choose_code(std::span<const T> samples, const Index3& size, T low) {
    const BrickCode coded = best_coded(samples, size, low);
    const auto bytes = static_cast<std::int64_t>(samples.size_bytes());
    return coded.bytes > bytes - bytes / kRawWhereLess<T> ? BrickCode{Head{Kind::raw}.byte(), 1 + bytes} : coded;
}

template <class T>
void encode_brick(std::span<const T> samples, const Index3& size, T low, std::uint8_t first, std::vector<std::byte>& out) {
    const Head head = Head::of(first);
    Numbers<Key<T>> numbers(samples.size());
    out.push_back(static_cast<std::byte>(first));
    if (head.kind == Kind::raw) {
        const std::span<const std::byte> bytes = std::as_bytes(samples);
        out.insert(out.end(), bytes.begin(), bytes.end());
        return;
    }
    if (head.kind == Kind::keys) {
        fill_keys(samples, low, numbers.samples());
        pack_groups<Key<T>>(arranged(numbers, size, head.orders).groups(), out);
        return;
    }
    if constexpr (std::floating_point<T>) {
        const Units units = units_of(samples).value();
        append_exponent(units.exponent, out);
        fill_units(samples, low, units, numbers.samples());
        pack_groups<Key<T>>(arranged(numbers, size, head.orders).groups(), out);
        if (!units.exact) append_tails(samples, units, out);
    }
}

template <class T>
bool decode_brick(std::span<const std::byte> packed, const Index3& size, T low, std::span<T> samples) {
    if (packed.empty()) {
        std::fill(samples.begin(), samples.end(), low);
        return true;
    }
    const Head head = Head::of(static_cast<std::uint8_t>(packed.front()));
    packed = packed.subspan(1);
    if (!head.is_known()) return false;
    if (head.kind == Kind::raw) {
        if (packed.size() != samples.size_bytes()) return false;
        std::memcpy(samples.data(), packed.data(), packed.size());
        return true;
    }
    if (head.kind == Kind::keys) return decode_keys(packed, size, low, head, samples);
    if constexpr (std::floating_point<T>) return decode_units(packed, size, low, head, samples);
    return false;
}

template <class T>
BrickCode code_as(std::span<const T> samples, const Index3& size, T low, std::uint8_t first) {
    const Head head = Head::of(first);
    bool fits = head.is_known();
    if (head.kind == Kind::exact_units || head.kind == Kind::units_with_tails) {
        fits = false;
        if constexpr (std::floating_point<T>) {
            const std::optional<Units> units = units_of(samples);
            fits = head.is_known() && units && units->exact == (head.kind == Kind::exact_units);
        }
    }
    if (!fits) return choose_code(samples, size, low);
    std::vector<std::byte> packed;
    encode_brick(samples, size, low, first, packed);
    return {first, static_cast<std::int64_t>(packed.size())};
}

#define ISOATLAS_INSTANTIATE(T)                                                                                 \
    template std::pair<T, T> extremes_of<T>(std::span<const T>);                                                \
    template BrickCode choose_code<T>(std::span<const T>, const Index3&, T);                                    \
    template BrickCode code_as<T>(std::span<const T>, const Index3&, T, std::uint8_t);                          \
    template void encode_brick<T>(std::span<const T>, const Index3&, T, std::uint8_t, std::vector<std::byte>&); \
    template bool decode_brick<T>(std::span<const std::byte>, const Index3&, T, std::span<T>);
ISOATLAS_FOR_SAMPLE_TYPES(ISOATLAS_INSTANTIATE)
#undef ISOATLAS_INSTANTIATE

}  // namespace isoatlas
