#include "codec/float_units.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

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
        std::memcpy(&word, next(), 8);
        word = word >> position_ % 8 & kMasks[static_cast<std::size_t>(bits)];
        position_ += static_cast<std::size_t>(bits);
        return word;
    }
    /// The byte of the next bit, with kLookedAt readable ones, and its place there.
    [[nodiscard]] const std::byte* next() const { return bytes_.data() + std::min(position_ / 8, size_); }
    [[nodiscard]] std::uint32_t place() const { return static_cast<std::uint32_t>(position_ % 8); }
    void skip(std::uint64_t bits) { position_ += bits; }
    [[nodiscard]] bool is_at_end() const { return (position_ + 7) / 8 == size_; }

    static constexpr std::size_t kLookedAt = 64;

private:
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

/// Adds its tail to a sample of whole units. The lowest bits of a mantissa are those below the unit.
template <class T>
T with_tail(T sample, Key<T> number, const Units& units, BitReader& reader) {
    if (number == 0) return take_small<T>(reader);
    const int bits = std::clamp(units.exponent - Parts<T>(sample).place, 0, 56);
    return std::bit_cast<T>(static_cast<Key<T>>(std::bit_cast<Key<T>>(sample) | reader.take(bits)));
}

template <class T>
void join_each(std::span<const Key<T>> numbers, const Units& units, std::size_t first, std::size_t end, BitReader& reader, T* samples) {
    for (std::size_t i = first; i < end; ++i) samples[i] = with_tail(samples[i], numbers[i], units, reader);
}

#if ISOATLAS_HAS_AVX512  // of that family of processors
/// Eight floats, none of 0 units, so none has more than 23 bits: they are whole in 4 bytes, wherever they begin.
[[gnu::always_inline]] ISOATLAS_FUSED inline void join_together(__m256i unit, BitReader& reader, float* samples) {
    const __m256i zero = _mm256_setzero_si256(), one = _mm256_set1_epi32(1);
    const __m256i sample = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(samples));
    const __m256i exponent = _mm256_and_si256(_mm256_srli_epi32(sample, 23), _mm256_set1_epi32(0xff));
    const __m256i own = _mm256_max_epi32(_mm256_sub_epi32(unit, _mm256_max_epi32(exponent, one)), zero);
    __m256i sum = own;  // of the tails up to each lane
    sum = _mm256_add_epi32(sum, _mm256_slli_si256(sum, 4));
    sum = _mm256_add_epi32(sum, _mm256_slli_si256(sum, 8));
    sum = _mm256_add_epi32(sum, _mm256_shuffle_epi32(_mm256_permute2x128_si256(sum, sum, 0x08), 0xff));
    const __m256i at = _mm256_add_epi32(_mm256_set1_epi32(static_cast<int>(reader.place())), _mm256_sub_epi32(sum, own));
    const __m256i word = _mm256_i32gather_epi32(reinterpret_cast<const int*>(reader.next()), _mm256_srli_epi32(at, 3), 1);
    const __m256i kept = _mm256_sub_epi32(_mm256_sllv_epi32(one, own), one);
    const __m256i tail = _mm256_and_si256(_mm256_srlv_epi32(word, _mm256_and_si256(at, _mm256_set1_epi32(7))), kept);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(samples), _mm256_or_si256(sample, tail));
    reader.skip(static_cast<std::uint32_t>(_mm256_extract_epi32(sum, 7)));
}

/// Four doubles with at most 52 bits each.
[[gnu::always_inline]] ISOATLAS_FUSED inline void join_together(__m256i unit, BitReader& reader, double* samples) {
    const __m256i one = _mm256_set1_epi64x(1);
    const __m256i sample = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(samples));
    const __m256i exponent = _mm256_and_si256(_mm256_srli_epi64(sample, 52), _mm256_set1_epi64x(0x7ff));
    // exponents are 0 in the upper halves of the lanes: 32 bits suffice to compare
    __m256i own = _mm256_sub_epi32(unit, _mm256_max_epi32(exponent, one));
    own = _mm256_max_epi32(own, _mm256_setzero_si256());
    __m256i sum = _mm256_add_epi64(own, _mm256_slli_si256(own, 8));
    sum = _mm256_add_epi64(sum, _mm256_shuffle_epi32(_mm256_permute2x128_si256(sum, sum, 0x08), 0xee));
    const __m256i at = _mm256_add_epi64(_mm256_set1_epi64x(reader.place()), _mm256_sub_epi64(sum, own));
    const __m256i word = _mm256_i64gather_epi64(reinterpret_cast<const long long*>(reader.next()), _mm256_srli_epi64(at, 3), 1);
    const __m256i kept = _mm256_sub_epi64(_mm256_sllv_epi64(one, own), one);
    const __m256i tail = _mm256_and_si256(_mm256_srlv_epi64(word, _mm256_and_si256(at, _mm256_set1_epi64x(7))), kept);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(samples), _mm256_or_si256(sample, tail));
    reader.skip(static_cast<std::uint64_t>(_mm256_extract_epi64(sum, 3)));
}

/// join_each() for all, in vectors where no number is 0.
template <class T>
ISOATLAS_FUSED void join_avx2(std::span<const Key<T>> numbers, const Units& units, BitReader& reader, std::span<T> samples) {
    constexpr std::size_t kLanes = 32 / sizeof(T);
    const int from_least = units.exponent - kMinPlace<T> + 1;  // the exponent of a float with the unit as its last place
    const __m256i unit = sizeof(T) == 4 ? _mm256_set1_epi32(from_least) : _mm256_set1_epi64x(from_least);
    std::size_t i = 0;
    for (; i + kLanes <= samples.size(); i += kLanes) {
        const __m256i number = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(numbers.data() + i));
        const __m256i zero = _mm256_setzero_si256();
        const __m256i is_zero = sizeof(T) == 4 ? _mm256_cmpeq_epi32(number, zero) : _mm256_cmpeq_epi64(number, zero);
        if (_mm256_testz_si256(is_zero, is_zero) != 0)
            join_together(unit, reader, samples.data() + i);
        else
            join_each<T>(numbers, units, i, i + kLanes, reader, samples.data());
    }
    join_each<T>(numbers, units, i, samples.size(), reader, samples.data());
}
#endif

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
bool join_tails(std::span<const Key<T>> numbers, std::span<const std::byte> tails, const Units& units, std::span<T> samples) {
    if (units.exponent < kMinPlace<T> || units.exponent >= std::numeric_limits<T>::max_exponent) return false;
    if (tails.size() > BitReader::kMax || samples.size() > static_cast<std::size_t>(kBrickSamples)) return false;
    from_units(numbers, units, samples);
    BitReader reader(tails);
#if ISOATLAS_HAS_AVX512
    if (kHasFused) {
        join_avx2(numbers, units, reader, samples);
        return reader.is_at_end();
    }
#endif
    join_each<T>(numbers, units, 0, samples.size(), reader, samples.data());
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
