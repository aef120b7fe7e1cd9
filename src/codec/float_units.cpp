#include "codec/float_units.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

#include "base/check.h"
#include "base/target_clones.h"
#include "field/brick_grid.h"

namespace isoatlas {
namespace {

template <class T>
constexpr int kDigits = std::numeric_limits<T>::digits;  ///< bits of a mantissa
template <class T>
constexpr int kMinPlace = std::numeric_limits<T>::min_exponent - kDigits<T>;  ///< 2^this is the smallest number

/// A float decomposed as mantissa * 2^place.
template <class T>
struct Parts {
    Key<T> mantissa;
    int place;

    explicit Parts(T sample) {
        constexpr int kStored = kDigits<T> - 1;
        const auto bits = static_cast<Key<T>>(std::bit_cast<Key<T>>(sample) << 1 >> 1);
        const int exponent = static_cast<int>(bits >> kStored);
        mantissa = bits & ((Key<T>{1} << kStored) - 1);
        if (exponent > 0) mantissa |= Key<T>{1} << kStored;
        place = exponent - (exponent > 0 ? 1 : 0) + kMinPlace<T>;
    }
};

template <class T>
bool is_positive_zero(T sample) {
    return std::bit_cast<Key<T>>(sample) == 0;
}

/// Calls put(value, bits) for every piece of the tails, at most 56 bits each.
template <class T, class Put>
void for_each_piece(std::span<const T> samples, const Units& units, const Put& put) {
    for (const T sample : samples) {
        const Parts<T> parts(sample);
        const int tail = units.exponent - parts.place;
        if (in_units(sample, units) != 0) {
            put(parts.mantissa & ((std::uint64_t{1} << tail) - 1), tail);
        } else if (is_positive_zero(sample)) {
            put(0, 1);
        } else {
            put(1, 1);
            std::uint64_t bits = std::bit_cast<Key<T>>(sample);
            for (std::size_t i = 0; i < sizeof(T); i += 4, bits >>= 32) put(bits & 0xffffffff, 32);
        }
    }
}

class BitReader {
public:
    explicit BitReader(std::span<const std::byte> bytes) : size_(bytes.size()) {
        ISOATLAS_CHECK(size_ <= kMax);
        std::copy(bytes.begin(), bytes.end(), bytes_.begin());
        std::fill_n(bytes_.begin() + static_cast<std::ptrdiff_t>(size_), kLookedAt, std::byte{0});
    }
    /// Upper bound of the bytes of the tails of a brick.
    static constexpr std::size_t kMax = static_cast<std::size_t>(kBrickSamples) * (sizeof(std::uint64_t) + 1);

    /// The next bits, at most 56; zeros after the end.
    std::uint64_t take(int bits) {
        std::uint64_t word;
        std::memcpy(&word, bytes_.data() + std::min(position_ / 8, size_), 8);
        word = word >> position_ % 8 & kMasks[static_cast<std::size_t>(bits)];
        position_ += static_cast<std::size_t>(bits);
        return word;
    }
    /// `bits` (at most 56) from a position on.
    [[nodiscard]] std::uint64_t at(std::size_t position, int bits) const {
        std::uint64_t word;
        std::memcpy(&word, bytes_.data() + position / 8, 8);
        return word >> position % 8 & ((std::uint64_t{1} << bits) - 1);
    }
    [[nodiscard]] const std::byte* data() const { return bytes_.data(); }
    [[nodiscard]] bool is_at_end() const { return ends_at(position_); }
    [[nodiscard]] bool ends_at(std::size_t position) const { return (position + 7) / 8 == size_; }

private:
    static constexpr std::size_t kLookedAt = 8;  ///< bytes after the end
    static constexpr std::array<std::uint64_t, 57> kMasks = [] {
        std::array<std::uint64_t, 57> masks{};
        for (std::size_t bits = 0; bits < masks.size(); ++bits) masks[bits] = (std::uint64_t{1} << bits) - 1;
        return masks;
    }();

    std::size_t size_, position_ = 0;
    std::array<std::byte, kMax + kLookedAt> bytes_;  // only read bytes are initialised
};

template <class T>
T take_small(BitReader& reader) {
    if (reader.take(1) == 0) return T{0};
    Key<T> bits = 0;
    for (std::size_t i = 0; i < sizeof(T); i += 4) bits |= static_cast<Key<T>>(reader.take(32)) << 8 * i;
    return std::bit_cast<T>(bits);
}

/// join_tails() where no sample is of 0 units: the position of each tail is known in advance.
template <class T>
[[gnu::always_inline]] inline bool join_each(const BitReader& reader, std::span<const std::int8_t> bits, std::span<T> samples) {
    std::array<std::uint32_t, kBrickSamples> position;
    std::uint32_t end = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) position[i] = std::exchange(end, end + static_cast<std::uint32_t>(bits[i]));
    if (!reader.ends_at(end)) return false;
    for (std::size_t i = 0; i < samples.size(); ++i)
        samples[i] = std::bit_cast<T>(static_cast<Key<T>>(std::bit_cast<Key<T>>(samples[i]) | reader.at(position[i], bits[i])));
    return true;
}

#if ISOATLAS_HAS_AVX512
constexpr std::int8_t kMaxTogether = 24;  ///< bits that are whole in 4 bytes, wherever they begin

/// AVX-512 version for 16 floats, none with more than kMaxTogether bits.
ISOATLAS_AVX512 bool join_wide(const BitReader& reader, std::span<const std::int8_t> bits, std::span<float> samples) {
    const __m512i zero = _mm512_setzero_si512(), one = _mm512_set1_epi32(1);
    __m512i end = zero;  // of the tails before, in every lane
    for (std::size_t i = 0; i < samples.size(); i += 16) {
        const auto lanes = static_cast<__mmask16>(samples.size() - i >= 16 ? 0xffff : (1 << (samples.size() - i)) - 1);
        const __m512i own = _mm512_maskz_cvtepi8_epi32(0xffff, _mm_maskz_loadu_epi8(lanes, bits.data() + i));
        __m512i sum = own;  // of the tails up to each lane
        sum = _mm512_add_epi32(sum, _mm512_maskz_alignr_epi32(0xffff, sum, zero, 15));
        sum = _mm512_add_epi32(sum, _mm512_maskz_alignr_epi32(0xffff, sum, zero, 14));
        sum = _mm512_add_epi32(sum, _mm512_maskz_alignr_epi32(0xffff, sum, zero, 12));
        sum = _mm512_add_epi32(sum, _mm512_maskz_alignr_epi32(0xffff, sum, zero, 8));
        const __m512i at = _mm512_add_epi32(end, _mm512_sub_epi32(sum, own));
        const __m512i word = _mm512_mask_i32gather_epi32(zero, lanes, _mm512_maskz_srli_epi32(0xffff, at, 3), reader.data(), 1);
        const __m512i tail = _mm512_and_si512(_mm512_maskz_srlv_epi32(0xffff, word, _mm512_and_si512(at, _mm512_set1_epi32(7))),
                                              _mm512_sub_epi32(_mm512_maskz_sllv_epi32(0xffff, one, own), one));
        const __m512i whole = _mm512_or_si512(_mm512_maskz_loadu_epi32(lanes, samples.data() + i), tail);
        _mm512_mask_storeu_epi32(samples.data() + i, lanes, whole);
        end = _mm512_add_epi32(end, _mm512_maskz_permutexvar_epi32(0xffff, _mm512_set1_epi32(15), sum));
    }
    return reader.ends_at(static_cast<std::uint32_t>(_mm_cvtsi128_si32(_mm512_maskz_extracti32x4_epi32(0xf, end, 0))));
}
#endif

/// join_each(), by the fastest code path of this processor.
template <class T>
[[gnu::always_inline]] inline bool join_fast(const BitReader& reader, std::span<const std::int8_t> bits, std::span<T> samples) {
#if ISOATLAS_HAS_AVX512
    if constexpr (std::is_same_v<T, float>) {
        if (kHasAvx512 && std::ranges::all_of(bits, [](std::int8_t own) { return own <= kMaxTogether; }))
            return join_wide(reader, bits, samples);
    }
#endif
    return join_each(reader, bits, samples);
}

template <class T>
T power_of_2(int exponent) {
    return std::ldexp(T{1}, exponent);
}

}  // namespace

template <class T>
std::optional<Units> units_of(std::span<const T> samples) {
    int max = kMinPlace<T>, common = std::numeric_limits<int>::max();
    bool finite = true, negative_zero = false;
    for (const T sample : samples) {
        const Parts<T> parts(sample);
        finite &= std::isfinite(sample);
        max = std::max(max, parts.place);
        if (parts.mantissa != 0) common = std::min(common, parts.place + std::countr_zero(parts.mantissa));
        negative_zero |= sample == 0 && !is_positive_zero(sample);
    }
    if (!finite) return std::nullopt;
    if (common == std::numeric_limits<int>::max()) common = max;  // zeros
    return Units{std::max(max, common), common >= max && !negative_zero};
}

template <class T>
Key<T> in_units(T sample, const Units& units) {
    const Parts<T> parts(sample);
    const int below = std::max(0, units.exponent - parts.place);
    const Key<T> magnitude = below >= static_cast<int>(8 * sizeof(T)) ? 0 : parts.mantissa >> below;
    return std::signbit(sample) ? static_cast<Key<T>>(Key<T>{0} - magnitude) : magnitude;
}

template <class T>
ISOATLAS_TARGET_CLONES void from_units(std::span<const Key<T>> numbers, const Units& units, std::span<T> samples) {
    const T unit = power_of_2<T>(units.exponent);
    for (std::size_t i = 0; i < samples.size(); ++i)
        samples[i] = static_cast<T>(static_cast<std::make_signed_t<Key<T>>>(numbers[i])) * unit;
}

template <class T>
std::int64_t tail_bits(std::span<const T> samples, const Units& units) {
    std::int64_t bits = 0;
    for_each_piece<T>(samples, units, [&bits](std::uint64_t, int more) { bits += more; });
    return bits;
}

template <class T>
void append_tails(std::span<const T> samples, const Units& units, std::vector<std::byte>& out) {
    std::uint64_t waiting = 0;
    int count = 0;
    for_each_piece<T>(samples, units, [&](std::uint64_t value, int bits) {
        waiting |= value << count;
        for (count += bits; count >= 8; count -= 8, waiting >>= 8) out.push_back(static_cast<std::byte>(waiting & 0xff));
    });
    if (count > 0) out.push_back(static_cast<std::byte>(waiting));
}

template <class T>
ISOATLAS_TARGET_CLONES bool join_tails(std::span<const Key<T>> numbers, std::span<const std::byte> tails, const Units& units,
                                       std::span<T> samples) {
    if (units.exponent < kMinPlace<T> || units.exponent >= std::numeric_limits<T>::max_exponent) return false;
    if (tails.size() > BitReader::kMax || samples.size() > static_cast<std::size_t>(kBrickSamples)) return false;
    from_units(numbers, units, samples);
    std::array<std::int8_t, kBrickSamples> bits;
    for (std::size_t i = 0; i < samples.size(); ++i)
        bits[i] = static_cast<std::int8_t>(std::clamp(units.exponent - Parts<T>(samples[i]).place, 0, 56));
    BitReader reader(tails);
    if (std::none_of(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(samples.size()), [](Key<T> n) { return n == 0; }))
        return join_fast<T>(reader, std::span<const std::int8_t>(bits).first(samples.size()), samples);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (numbers[i] == 0) {
            samples[i] = take_small<T>(reader);
        } else {  // the lowest bits of a mantissa are those below the unit
            samples[i] = std::bit_cast<T>(static_cast<Key<T>>(std::bit_cast<Key<T>>(samples[i]) | reader.take(bits[i])));
        }
    }
    return reader.is_at_end();
}

// NOLINTBEGIN(bugprone-macro-parentheses): the argument is a type
#define ISOATLAS_INSTANTIATE(T)                                                            \
    template std::optional<Units> units_of(std::span<const T>);                            \
    template Key<T> in_units(T, const Units&);                                             \
    template void from_units(std::span<const Key<T>>, const Units&, std::span<T>);         \
    template std::int64_t tail_bits(std::span<const T>, const Units&);                     \
    template void append_tails(std::span<const T>, const Units&, std::vector<std::byte>&); \
    template bool join_tails(std::span<const Key<T>>, std::span<const std::byte>, const Units&, std::span<T>)
ISOATLAS_INSTANTIATE(float);
ISOATLAS_INSTANTIATE(double);
#undef ISOATLAS_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace isoatlas
