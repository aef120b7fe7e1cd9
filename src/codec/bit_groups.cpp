#include "codec/bit_groups.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "base/target_clones.h"

namespace isoatlas {
namespace {

constexpr int kWidest = 64;
constexpr std::size_t kTogether = 128;  ///< groups that are read together: those of a brick

/// Widths of groups are stored in `more` bits, minus `min`.
struct Widths {
    int min = 0, more = 0;
    std::int64_t bytes = 0;  ///< of everything
};

/// Transposes 8 x 8 bits (Warren, Hacker's Delight, 7-3).
[[gnu::always_inline]] inline std::uint64_t transposed(std::uint64_t bits) {
    std::uint64_t change = (bits ^ bits >> 7) & 0x00aa00aa00aa00aa;
    bits ^= change ^ change << 7;
    change = (bits ^ bits >> 14) & 0x0000cccc0000cccc;
    bits ^= change ^ change << 14;
    change = (bits ^ bits >> 28) & 0x00000000f0f0f0f0;
    return bits ^ change ^ change << 28;
}

template <class N>
int width_of(const N* group) {
    N all = 0;
    for (std::size_t i = 0; i < kGroup; ++i) all |= group[i];
    return static_cast<int>(std::bit_width(all));
}

std::int64_t bytes_of_widths(std::int64_t groups, int more) { return (groups + 7) / 8 * more; }

/// The cheapest coding of the widths: narrow groups may be stored wider than necessary.
template <class N>
Widths best_widths(std::span<const N> numbers) {
    std::array<std::int64_t, kWidest + 1> count{};
    for (std::size_t i = 0; i < numbers.size(); i += kGroup) ++count[static_cast<std::size_t>(width_of(numbers.data() + i))];
    const auto groups = static_cast<std::int64_t>(numbers.size() / kGroup);
    const auto first = std::find_if(count.begin(), count.end(), [](std::int64_t n) { return n > 0; });
    const int narrowest = static_cast<int>(first - count.begin());
    int widest = kWidest;
    while (widest > narrowest && count[static_cast<std::size_t>(widest)] == 0) --widest;
    Widths best;
    for (int more = 0;; ++more) {
        const int min = std::max(narrowest, widest - (1 << more) + 1);
        std::int64_t bytes = 2 + bytes_of_widths(groups, more);
        for (int w = narrowest; w <= widest; ++w) bytes += count[static_cast<std::size_t>(w)] * std::max(w, min);
        if (more == 0 || bytes < best.bytes) best = {min, more, bytes};
        if (min == narrowest) return best;
    }
}

template <class N>
void append_group(const N* group, int width, std::vector<std::byte>& out) {
    for (int done = 0; done < width; done += 8) {
        std::uint64_t bytes = 0;
        for (std::size_t i = 0; i < kGroup; ++i) bytes |= (static_cast<std::uint64_t>(group[i]) >> done & 0xff) << 8 * i;
        const int left = std::min(8, width - done);
        if (left < 8) bytes = transposed(bytes);
        std::array<std::byte, 8> raw;
        std::memcpy(raw.data(), &bytes, 8);
        out.insert(out.end(), raw.begin(), raw.begin() + left);
    }
}

template <class N>
constexpr std::size_t kLookedAt = std::max<std::size_t>(8 * sizeof(N) + 8, 32);  ///< bytes read from the start of a group

std::uint64_t word_at(const std::byte* from) {
    std::uint64_t word;
    std::memcpy(&word, from, 8);
    return word;
}

/// The bits that whole bytes leave of a group: the next bytes of its 8 numbers.
[[gnu::always_inline]] inline std::uint64_t last_bytes(const std::byte* from, int width) {
    return transposed(word_at(from + width / 8 * 8) & ((std::uint64_t{1} << width % 8 * 8) - 1));
}

/// Reads one group, branch-free.
template <class N>
[[gnu::always_inline]] inline void read_group(const std::byte* from, int width, N* group) {
    const int whole = width / 8;
    std::array<std::uint64_t, sizeof(N) + 1> words;  // bytes k of the 8 numbers
    for (int k = 0; k < static_cast<int>(sizeof(N)); ++k) words[static_cast<std::size_t>(k)] = k < whole ? word_at(from + 8 * k) : 0;
    words[static_cast<std::size_t>(whole)] = last_bytes(from, width);
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(words.data());
    std::array<N, kGroup> numbers{};
    for (std::size_t k = 0; k < sizeof(N); ++k) {
        for (std::size_t i = 0; i < kGroup; ++i) numbers[i] |= static_cast<N>(static_cast<N>(bytes[8 * k + i]) << 8 * k);
    }
    std::copy(numbers.begin(), numbers.end(), group);
}

#if ISOATLAS_HAS_AVX512  // of that family of processors
[[gnu::always_inline]] ISOATLAS_FUSED inline __m256i swapped_avx2(__m256i bits, long long mask, int places) {
    const __m256i change = _mm256_and_si256(_mm256_xor_si256(bits, _mm256_srli_epi64(bits, places)), _mm256_set1_epi64x(mask));
    return _mm256_xor_si256(_mm256_xor_si256(bits, change), _mm256_slli_epi64(change, places));
}

/// transposed() of four.
[[gnu::always_inline]] ISOATLAS_FUSED inline __m256i transposed_avx2(__m256i bits) {
    bits = swapped_avx2(bits, 0x00aa00aa00aa00aa, 7);
    bits = swapped_avx2(bits, 0x0000cccc0000cccc, 14);
    return swapped_avx2(bits, 0x00000000f0f0f0f0, 28);
}

[[gnu::always_inline]] ISOATLAS_FUSED inline __m256i load_avx2(const void* from) {
    return _mm256_loadu_si256(static_cast<const __m256i*>(from));
}

/// last_bytes() of all groups, 8 bytes each, four at a time: widths and last end at a multiple of four.
ISOATLAS_FUSED void last_bytes_avx2(const std::byte* from, std::span<const std::uint8_t> widths, std::uint8_t* last) {
    const __m256i one = _mm256_set1_epi64x(1);
    for (std::size_t i = 0; i < widths.size(); i += 4, last += 4 * kGroup) {
        const auto next = [&](std::size_t k) {
            const std::uint64_t word = word_at(from + widths[i + k] / 8 * 8);
            from += widths[i + k];
            return static_cast<long long>(word);
        };
        const long long first = next(0), second = next(1), third = next(2), fourth = next(3);
        const __m256i words =
            _mm256_setr_epi64x(first, second, third, fourth);  // not through memory: narrower stores would have to end first
        std::uint32_t four;
        std::memcpy(&four, widths.data() + i, 4);
        const __m256i bits = _mm256_and_si256(_mm256_cvtepu8_epi64(_mm_cvtsi32_si128(static_cast<int>(four))), _mm256_set1_epi64x(7));
        const __m256i kept = _mm256_sub_epi64(_mm256_sllv_epi64(one, _mm256_slli_epi64(bits, 3)), one);
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(last), transposed_avx2(_mm256_and_si256(words, kept)));
    }
}

/// Words 0 .. whole - 1 of a group as they are, its bits as word `whole`, then nothing.
template <class N>
struct WordMasks {
    static constexpr std::size_t kWords = sizeof(N) <= 4 ? 4 : 8;
    alignas(32) std::array<std::array<std::uint64_t, kWords>, sizeof(N) + 1> kept{}, bits{};

    constexpr WordMasks() {
        for (std::size_t whole = 0; whole <= sizeof(N); ++whole) {
            for (std::size_t k = 0; k < kWords; ++k)
                kept[whole][k] = k < whole ? ~std::uint64_t{0} : 0, bits[whole][k] = k == whole ? ~std::uint64_t{0} : 0;
        }
    }
};
template <class N>
constexpr WordMasks<N> kWordMasks;

/// Words 4 * half .. 4 * half + 3 of a group.
template <class N>
[[gnu::always_inline]] ISOATLAS_FUSED inline __m256i four_words(const std::byte* from, std::size_t whole, std::uint64_t last,
                                                                std::size_t half) {
    const __m256i kept = _mm256_and_si256(load_avx2(from + 32 * half), load_avx2(kWordMasks<N>.kept[whole].data() + 4 * half));
    const __m256i bits = load_avx2(kWordMasks<N>.bits[whole].data() + 4 * half);
    return _mm256_or_si256(kept, _mm256_and_si256(_mm256_set1_epi64x(static_cast<long long>(last)), bits));
}

/// Four words by eight bytes as eight numbers by four bytes.
[[gnu::always_inline]] ISOATLAS_FUSED inline __m256i eight_numbers(__m256i words) {
    const __m256i halves = _mm256_setr_epi32(0, 2, 4, 6, 1, 3, 5, 7);  // of the words: numbers 0 to 3, 4 to 7
    const __m256i bytes =
        _mm256_setr_epi8(0, 4, 8, 12, 1, 5, 9, 13, 2, 6, 10, 14, 3, 7, 11, 15, 0, 4, 8, 12, 1, 5, 9, 13, 2, 6, 10, 14, 3, 7, 11, 15);
    return _mm256_shuffle_epi8(_mm256_permutevar8x32_epi32(words, halves), bytes);
}

[[gnu::always_inline]] ISOATLAS_FUSED inline void read_group_avx2(const std::byte* from, int width, std::uint64_t last,
                                                                  std::uint16_t* group) {
    const __m128i bytes = _mm_setr_epi8(0, 8, 1, 9, 2, 10, 3, 11, 4, 12, 5, 13, 6, 14, 7, 15);
    const __m128i words = _mm256_castsi256_si128(four_words<std::uint16_t>(from, static_cast<std::size_t>(width / 8), last, 0));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(group), _mm_shuffle_epi8(words, bytes));
}

[[gnu::always_inline]] ISOATLAS_FUSED inline void read_group_avx2(const std::byte* from, int width, std::uint64_t last,
                                                                  std::uint32_t* group) {
    const __m256i words = four_words<std::uint32_t>(from, static_cast<std::size_t>(width / 8), last, 0);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(group), eight_numbers(words));
}

[[gnu::always_inline]] ISOATLAS_FUSED inline void read_group_avx2(const std::byte* from, int width, std::uint64_t last,
                                                                  std::uint64_t* group) {
    const auto whole = static_cast<std::size_t>(width / 8);
    const __m256i low = eight_numbers(four_words<std::uint64_t>(from, whole, last, 0));
    const __m256i high = eight_numbers(four_words<std::uint64_t>(from, whole, last, 1));
    const __m256i even = _mm256_unpacklo_epi32(low, high), odd = _mm256_unpackhi_epi32(low, high);  // 0 1 4 5, 2 3 6 7
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(group), _mm256_permute2x128_si256(even, odd, 0x20));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(group + 4), _mm256_permute2x128_si256(even, odd, 0x31));
}

template <class N>
ISOATLAS_FUSED void read_groups_avx2(const std::byte* from, std::span<const std::uint8_t> widths, N* numbers) {
    alignas(32) std::array<std::uint8_t, kGroup * kTogether> last;
    const std::span<const std::uint8_t> fours(widths.data(), (widths.size() + 3) / 4 * 4);
    if constexpr (sizeof(N) == 1) {  // of one byte it is all, but for groups of 8 bits
        last_bytes_avx2(from, fours, fours.size() == widths.size() ? numbers : last.data());
        if (fours.size() != widths.size()) std::memcpy(numbers, last.data(), kGroup * widths.size());
        if (std::memchr(widths.data(), 8, widths.size()) == nullptr) return;
        for (std::size_t i = 0; i < widths.size(); from += widths[i++]) {
            if (widths[i] == 8) std::memcpy(numbers + kGroup * i, from, kGroup);
        }
    } else {
        last_bytes_avx2(from, fours, last.data());
        for (std::size_t i = 0; i < widths.size(); from += widths[i++]) {
            std::uint64_t bits;
            std::memcpy(&bits, last.data() + kGroup * i, sizeof bits);
            read_group_avx2(from, widths[i], bits, numbers + kGroup * i);
        }
    }
}
#endif

/// Consecutive groups, at most kTogether; kLookedAt bytes are readable from the start of the last one, and zeros follow the widths up to a
/// multiple of 4.
template <class N>
void read_groups(const std::byte* from, std::span<const std::uint8_t> widths, N* numbers) {
#if ISOATLAS_HAS_AVX512
    if (kHasFused) return read_groups_avx2(from, widths, numbers);
#endif
    for (const int width : widths) {
        read_group(from, width, numbers);
        from += width, numbers += kGroup;
    }
}

/// Reads groups of variable widths, whose sum is `size`, zeros behind the widths as read_groups() needs them; false when the input is too
/// short. The last groups, from where on fewer bytes than kLookedAt are left, are read from a copy with zeros behind it.
template <class N>
bool take_groups(std::span<const std::byte>& packed, std::span<const std::uint8_t> widths, std::size_t size, N* numbers) {
    if (packed.size() < size) return false;
    std::size_t copied = widths.size(), end = size;  // groups from `copied` on begin at `end`
    while (copied > 0 && packed.size() - end < kLookedAt<N>) end -= widths[--copied];
    if (copied < widths.size() && packed.size() - end >= kLookedAt<N>) end += widths[copied++];
    for (; copied % 4 != 0; --copied) end -= widths[copied - 1];
    read_groups(packed.data(), widths.first(copied), numbers);
    if (copied < widths.size()) {
        std::array<std::byte, kTogether * 8 * sizeof(N) + kLookedAt<N>> padded;
        std::copy_n(packed.begin() + static_cast<std::ptrdiff_t>(end), size - end, padded.begin());
        std::fill_n(padded.begin() + static_cast<std::ptrdiff_t>(size - end), kLookedAt<N>, std::byte{0});
        read_groups(padded.data(), widths.subspan(copied), numbers + copied * kGroup);
    }
    packed = packed.subspan(size);
    return true;
}

/// Widths of at most kTogether groups, zeros up to a multiple of 8.
struct WidthsOfGroups {
    std::array<std::uint8_t, kTogether> of;
    int max = 0;
    std::size_t sum = 0;

    /// Reads those of `count` groups, stored in `more` bits each, less `min`; false when the input is too short.
    [[nodiscard, gnu::always_inline]] bool take(std::span<const std::byte>& packed, std::size_t count, int min, int more) {
        const std::size_t eights = (count + 7) / 8;
        std::array<std::uint8_t, kTogether / 8> equal{};
        std::fill_n(equal.begin(), eights, static_cast<std::uint8_t>(more));
        of.fill(0);
        if (!take_groups<std::uint8_t>(packed, std::span(equal).first(eights), eights * static_cast<std::size_t>(more), of.data()))
            return false;
        finish(count, min);
        return true;
    }

private:
    [[gnu::always_inline]] void finish(std::size_t count, int min) {
        for (std::size_t i = count; i < kTogether && i % 8 != 0; ++i) of[i] = 0;
        std::uint8_t widest = 0;
        std::uint32_t all = 0;
        for (std::size_t i = 0; i < kTogether; ++i) widest = std::max(widest, of[i]), all += of[i];
        for (std::size_t i = 0; i < count; ++i) of[i] = static_cast<std::uint8_t>(of[i] + min);
        max = widest + min;
        sum = all + count * static_cast<std::size_t>(min);
    }
};

}  // namespace

template <class N>
ISOATLAS_TARGET_CLONES std::int64_t group_bytes(std::span<const N> numbers) {
    return best_widths(numbers).bytes;
}

template <class N>
void pack_groups(std::span<const N> numbers, std::vector<std::byte>& out) {
    const Widths widths = best_widths(numbers);
    out.push_back(static_cast<std::byte>(widths.min));
    out.push_back(static_cast<std::byte>(widths.more));
    const auto stored_width = [&](std::size_t i) { return std::max(widths.min, width_of(numbers.data() + i)); };
    for (std::size_t i = 0; i < numbers.size(); i += 8 * kGroup) {
        std::array<std::uint8_t, kGroup> above{};
        for (std::size_t k = 0; k < 8 && i + k * kGroup < numbers.size(); ++k)
            above[k] = static_cast<std::uint8_t>(stored_width(i + k * kGroup) - widths.min);
        append_group(above.data(), widths.more, out);
    }
    for (std::size_t i = 0; i < numbers.size(); i += kGroup) append_group(numbers.data() + i, stored_width(i), out);
}

template <class N>
ISOATLAS_TARGET_CLONES bool unpack_groups(std::span<const std::byte>& packed, std::span<N> numbers) {
    if (packed.size() < 2) return false;
    const int min = static_cast<int>(packed[0]), more = static_cast<int>(packed[1]);
    packed = packed.subspan(2);
    const std::int64_t size = bytes_of_widths(static_cast<std::int64_t>(numbers.size() / kGroup), more);
    if (more > 7 || static_cast<std::int64_t>(packed.size()) < size) return false;
    std::span<const std::byte> widths = packed.first(static_cast<std::size_t>(size));
    packed = packed.subspan(widths.size());
    for (std::size_t i = 0; i < numbers.size(); i += kTogether * kGroup) {
        const std::size_t count = std::min(kTogether, (numbers.size() - i) / kGroup);
        WidthsOfGroups widths_of;
        if (!widths_of.take(widths, count, min, more) || widths_of.max > static_cast<int>(8 * sizeof(N))) return false;
        if (!take_groups<N>(packed, std::span(widths_of.of).first(count), widths_of.sum, numbers.data() + i)) return false;
    }
    return true;
}

#define ISOATLAS_INSTANTIATE(N)                                                \
    template std::int64_t group_bytes<N>(std::span<const N>);                  \
    template void pack_groups<N>(std::span<const N>, std::vector<std::byte>&); \
    template bool unpack_groups<N>(std::span<const std::byte>&, std::span<N>)
ISOATLAS_INSTANTIATE(std::uint8_t);
ISOATLAS_INSTANTIATE(std::uint16_t);
ISOATLAS_INSTANTIATE(std::uint32_t);
ISOATLAS_INSTANTIATE(std::uint64_t);
#undef ISOATLAS_INSTANTIATE

}  // namespace isoatlas
