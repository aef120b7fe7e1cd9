// AVX2 version of plain_cells.h: 64 patterns at once, and the eight counters as two vectors.
#pragma once

#include <algorithm>

#include "base/target_clones.h"
#include "mesh/plain_cells.h"

#if ISOATLAS_HAS_AVX512  // a processor of that family, perhaps without those vectors

namespace isoatlas {

/// The patterns of the 64 cells of word w.
[[gnu::always_inline]] ISOATLAS_FUSED inline void patterns_avx2(const CellRow<4>& rows, std::int64_t w,
                                                                std::array<std::uint8_t, 64>& patterns) {
    const __m256i byte_of = _mm256_setr_epi64x(0, 0x0101010101010101, 0x0202020202020202, 0x0303030303030303);
    const __m256i bit_of = _mm256_set1_epi64x(static_cast<long long>(0x8040201008040201));
    for (int half = 0; half < 2; ++half) {
        __m256i pattern = _mm256_setzero_si256();
        for (unsigned r = 0; r < 4; ++r) {
            const std::uint64_t* row = rows.row[r];
            for (unsigned corner = 0; corner < 2; ++corner) {
                const std::uint64_t word = (corner == 0 ? row[w] : bits_after(row, w)) >> 32 * half;
                const __m256i bytes = _mm256_shuffle_epi8(_mm256_set1_epi32(static_cast<int>(word)), byte_of);
                const __m256i is_high = _mm256_cmpeq_epi8(_mm256_and_si256(bytes, bit_of), bit_of);
                pattern = _mm256_or_si256(pattern, _mm256_and_si256(is_high, _mm256_set1_epi8(static_cast<char>(1U << (2 * r + corner)))));
            }
        }
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(patterns.data() + 32 * half), pattern);
    }
}

/// count_plain().
template <class Rest>
ISOATLAS_FUSED void count_avx2(const CellRow<4>& rows, const CellWindow& window, const PlainCells& cells, RowOffsets& place, Rest&& rest) {
    RowOffsets own{};
    alignas(32) std::array<std::uint8_t, 64> patterns;
    for (std::int64_t i = 0; i < rows.candidates.size; ++i) {
        for (std::uint64_t candidates = rows.candidates.bits[i]; candidates != 0; candidates &= candidates - 1) {
            const std::int64_t w = 64 * i + std::countr_zero(candidates);
            const std::uint64_t inside = window.mask(w);
            count_hits(w, (rows.row[0][w] ^ bits_after(rows.row[0], w)) & inside, rows.row[0][w] ^ rows.row[1][w],
                       rows.row[0][w] ^ rows.row[2][w], own);
            std::uint64_t active = rows.active(w) & inside;
            if (active == 0) continue;
            mark_word(own.cell_words, w);
            patterns_avx2(rows, w, patterns);
            for (; active != 0; active &= active - 1) {
                const int bit = std::countr_zero(active);
                const std::size_t pattern = patterns[static_cast<std::size_t>(bit)];
                const int triangles = cells.triangles[pattern];
                own.triangle += triangles;
                if (triangles == 0) rest(64 * w + bit, static_cast<int>(pattern));
            }
        }
    }
    place.triangle += own.triangle;
    place.x_hits += own.x_hits, place.y_hits += own.y_hits, place.z_hits += own.z_hits;
    place.hit_words |= own.hit_words, place.cell_words |= own.cell_words;
}

/// write_plain().
template <class Rest>
ISOATLAS_FUSED void write_avx2(const CellRow<4>& rows, const CellWindow& window, const PlainCells& cells, const HitCounters& first,
                               std::array<std::int64_t, 3>* triangle, Rest&& rest) {
    alignas(32) std::array<std::int64_t, 16> both;  // counters before and after a cell
    alignas(32) std::array<std::uint8_t, 64> patterns;
    __m256i low = _mm256_set_epi64x(first[3], first[2], first[1], first[0]),
            high = _mm256_set_epi64x(first[7], first[6], first[5], first[4]);
    auto* const stored = reinterpret_cast<__m256i*>(both.data());
    const __m256i low_bits = _mm256_setr_epi64x(1, 2, 4, 8), high_bits = _mm256_setr_epi64x(16, 32, 64, 128);
    for (std::int64_t i = 0; i < rows.candidates.size; ++i) {
        for (std::uint64_t candidates = rows.candidates.bits[i]; candidates != 0; candidates &= candidates - 1) {
            const std::int64_t w = 64 * i + std::countr_zero(candidates);
            std::uint64_t active = rows.active(w) & window.mask(w);
            if (active == 0) continue;
            patterns_avx2(rows, w, patterns);
            for (; active != 0; active &= active - 1) {
                const int bit = std::countr_zero(active);
                const std::size_t pattern = patterns[static_cast<std::size_t>(bit)];
                const __m256i moves = _mm256_set1_epi64x(cells.moves[pattern]);
                _mm256_store_si256(stored, low), _mm256_store_si256(stored + 1, high);
                // A bit that is set becomes -1, which is subtracted.
                low = _mm256_sub_epi64(low, _mm256_cmpeq_epi64(_mm256_and_si256(moves, low_bits), low_bits));
                high = _mm256_sub_epi64(high, _mm256_cmpeq_epi64(_mm256_and_si256(moves, high_bits), high_bits));
                _mm256_store_si256(stored + 2, low), _mm256_store_si256(stored + 3, high);
                const int count = cells.triangles[pattern];
                if (count == 0) {
                    HitCounters before, after;
                    std::copy_n(both.begin(), 8, before.begin());
                    std::copy_n(both.begin() + 8, 8, after.begin());
                    rest(64 * w + bit, static_cast<int>(pattern), before, after, triangle);
                    continue;
                }
                const std::uint8_t* corner = cells.corner[pattern].data();
                for (int t = 0; t < count; ++t, corner += 3) *triangle++ = {both[corner[0]], both[corner[1]], both[corner[2]]};
            }
        }
    }
}

}  // namespace isoatlas

#endif
