// AVX-512 version of plain_cells.h: 64 patterns at once, and up to five triangles of a cell by two permutations of its 16 numbers.
#pragma once

#include "base/prefetch.h"
#include "base/target_clones.h"
#include "mesh/plain_cells.h"

#if ISOATLAS_HAS_AVX512

namespace isoatlas {

/// Word w of four rows, and the bits that follow it: row r as bit 2 r.
struct RowWords {
    std::array<std::uint64_t, 4> row;
    std::uint64_t after;
    RowWords(const CellRow<4>& rows, std::int64_t w) : after(0) {
        for (unsigned r = 0; r < 4; ++r) {
            row[r] = rows.row[r][w];
            after |= (rows.row[r][w + 1] & 1) << 2 * r;
        }
    }
};

/// The patterns of its 64 cells.
[[gnu::always_inline]] ISOATLAS_AVX512 inline __m512i patterns_avx512(const RowWords& words) {
    alignas(64) static constexpr std::array<std::uint8_t, 64> kNext = [] {
        std::array<std::uint8_t, 64> next{};
        for (std::size_t i = 0; i < next.size(); ++i) next[i] = static_cast<std::uint8_t>(i + 1);
        return next;
    }();
    __m512i here = _mm512_maskz_mov_epi8(words.row[0], _mm512_set1_epi8(1));
    for (unsigned r = 1; r < 4; ++r) here = _mm512_mask_add_epi8(here, words.row[r], here, _mm512_set1_epi8(static_cast<char>(1 << 2 * r)));
    __m512i next = _mm512_maskz_permutexvar_epi8(~std::uint64_t{0}, _mm512_load_si512(kNext.data()), here);
    next = _mm512_mask_set1_epi8(next, std::uint64_t{1} << 63, static_cast<char>(words.after));
    return _mm512_add_epi8(here, _mm512_add_epi8(next, next));
}

/// count_plain().
template <class Rest>
ISOATLAS_AVX512 void count_avx512(const CellRow<4>& rows, const CellWindow& window, const PlainCells& cells, RowOffsets& place,
                                  Rest&& rest) {
    const std::uint8_t* const table = cells.triangles.data();
    const __m512i first = _mm512_loadu_si512(table), second = _mm512_loadu_si512(table + 64), third = _mm512_loadu_si512(table + 128),
                  fourth = _mm512_loadu_si512(table + 192);
    __m512i sums = _mm512_setzero_si512();
    RowOffsets own{};
    for (std::int64_t i = 0; i < rows.candidates.size; ++i) {
        for (std::uint64_t candidates = rows.candidates.bits[i]; candidates != 0; candidates &= candidates - 1) {
            const std::int64_t w = 64 * i + std::countr_zero(candidates);
            const RowWords words(rows, w);
            const auto& [r0, r1, r2, r3] = words.row;
            const std::uint64_t x = r0 ^ (r0 >> 1 | words.after << 63);
            const bool is_same_after = words.after == (words.after & 1) * 0x55;
            if ((x | (r0 ^ r1) | (r0 ^ r2) | (r0 ^ r3)) == 0 && is_same_after) continue;
            const std::uint64_t inside = window.mask(w);
            count_hits(w, x & inside, r0 ^ r1, r0 ^ r2, own);
            const __m512i patterns = patterns_avx512(words);
            const std::uint64_t not_low = _mm512_mask_test_epi8_mask(inside, patterns, patterns);
            const std::uint64_t active = _mm512_mask_cmpneq_epi8_mask(not_low, patterns, _mm512_set1_epi8(-1));
            if (active == 0) continue;
            mark_word(own.cell_words, w);
            const __m512i low = _mm512_permutex2var_epi8(first, patterns, second);
            const __m512i high = _mm512_permutex2var_epi8(third, patterns, fourth);
            const __m512i triangles = _mm512_maskz_mov_epi8(active, _mm512_mask_blend_epi8(_mm512_movepi8_mask(patterns), low, high));
            sums = _mm512_add_epi64(sums, _mm512_sad_epu8(triangles, _mm512_setzero_si512()));
            std::uint64_t others = _mm512_mask_testn_epi8_mask(active, triangles, triangles);
            if (others == 0) continue;
            alignas(64) std::array<std::uint8_t, 64> pattern;
            _mm512_store_si512(pattern.data(), patterns);
            for (; others != 0; others &= others - 1) {
                const int bit = std::countr_zero(others);
                rest(64 * w + bit, static_cast<int>(pattern[static_cast<std::size_t>(bit)]));
            }
        }
    }
    alignas(64) std::array<std::int64_t, 8> parts;
    _mm512_store_si512(parts.data(), sums);
    for (const std::int64_t part : parts) place.triangle += part;
    place.x_hits += own.x_hits, place.y_hits += own.y_hits, place.z_hits += own.z_hits;
    place.hit_words |= own.hit_words, place.cell_words |= own.cell_words;
}

/// write_plain().
template <class Rest>
ISOATLAS_AVX512 void write_avx512(const CellRow<4>& rows, const CellWindow& window, const PlainCells& cells, const HitCounters& first,
                                  std::array<std::int64_t, 3>* triangle, const std::array<std::int64_t, 3>* end, Rest&& rest) {
    constexpr std::ptrdiff_t kWritten = 6;  // triangles, the last one not whole: what two vectors overwrite
    constexpr int kLines = 6;               // of 64 bytes: about what a word of cells writes
    const __m512i one = _mm512_set1_epi64(1);
    // Element by element: a vector load would wait for the stores of its elements.
    __m512i next = _mm512_set_epi64(first[7], first[6], first[5], first[4], first[3], first[2], first[1], first[0]);
    alignas(64) std::array<std::uint8_t, 64> patterns;
    for (std::int64_t i = 0; i < rows.candidates.size; ++i) {
        for (std::uint64_t candidates = rows.candidates.bits[i]; candidates != 0; candidates &= candidates - 1) {
            const std::int64_t w = 64 * i + std::countr_zero(candidates);
            std::uint64_t active = rows.active(w) & window.mask(w);
            if (active == 0) continue;
            _mm512_store_si512(patterns.data(), patterns_avx512(RowWords(rows, w)));
            for (int line = 0; line < kLines; ++line) prefetch_to_write(reinterpret_cast<const char*>(triangle) + 64 * (kLines + 4 + line));
            for (; active != 0; active &= active - 1) {
                const int bit = std::countr_zero(active);
                const std::size_t pattern = patterns[static_cast<std::size_t>(bit)];
                const __m512i after = _mm512_mask_add_epi64(next, cells.moves[pattern], next, one);
                const int count = cells.triangles[pattern];
                if (count == 0) {
                    HitCounters before_cell, after_cell;
                    _mm512_storeu_si512(before_cell.data(), next);
                    _mm512_storeu_si512(after_cell.data(), after);
                    rest(64 * w + bit, static_cast<int>(pattern), before_cell, after_cell, triangle);
                } else {
                    const auto* corner = reinterpret_cast<const __m128i*>(cells.corner[pattern].data());
                    const __m128i corners = _mm_loadu_si128(corner);
                    const __m512i head = _mm512_permutex2var_epi64(next, _mm512_maskz_cvtepu8_epi64(0xff, corners), after);
                    const __m512i tail =
                        _mm512_permutex2var_epi64(next, _mm512_maskz_cvtepu8_epi64(0xff, _mm_bsrli_si128(corners, 8)), after);
                    if (end - triangle >= kWritten) {
                        _mm512_storeu_si512(triangle, head);
                        _mm512_storeu_si512(reinterpret_cast<std::int64_t*>(triangle) + 8, tail);
                    } else {
                        const unsigned numbers = (1U << 3 * count) - 1;
                        _mm512_mask_storeu_epi64(triangle, static_cast<__mmask8>(numbers), head);
                        _mm512_mask_storeu_epi64(reinterpret_cast<std::int64_t*>(triangle) + 8, static_cast<__mmask8>(numbers >> 8), tail);
                    }
                    triangle += count;
                }
                next = after;
            }
        }
    }
}

}  // namespace isoatlas

#endif
