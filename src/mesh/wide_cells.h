// plain_cells.h with vectors of 512 bits, where the processor has them: 64 patterns at once, and up to five triangles of a cell by two
// permutations of the 16 numbers that its hits are among.
#pragma once

#include "base/wide.h"
#include "mesh/plain_cells.h"

#if ISOATLAS_HAS_WIDE_512

namespace isoatlas {

/// The patterns of the 64 cells of word w.
[[gnu::always_inline]] ISOATLAS_WIDE_512 inline __m512i wide_patterns(const CellRow<4>& rows, std::int64_t w) {
    __m512i patterns = _mm512_setzero_si512();
    for (int r = 0; r < 4; ++r) {
        const std::uint64_t* bits = rows.row[static_cast<std::size_t>(r)];
        const __m512i here = _mm512_set1_epi8(static_cast<char>(1 << 2 * r)), after = _mm512_set1_epi8(static_cast<char>(2 << 2 * r));
        patterns = _mm512_or_si512(patterns, _mm512_maskz_mov_epi8(bits[w], here));
        patterns = _mm512_or_si512(patterns, _mm512_maskz_mov_epi8(bits[w] >> 1 | bits[w + 1] << 63, after));
    }
    return patterns;
}

/// count_plain().
template <class Rest>
ISOATLAS_WIDE_512 void count_wide(const CellRow<4>& rows, const CellWindow& window, const PlainCells& cells, RowPlace& place, Rest&& rest) {
    const std::uint8_t* const table = cells.triangles.data();
    const __m512i first = _mm512_loadu_si512(table), second = _mm512_loadu_si512(table + 64), third = _mm512_loadu_si512(table + 128),
                  fourth = _mm512_loadu_si512(table + 192);
    __m512i sums = _mm512_setzero_si512();
    for (std::int64_t i = 0; i < rows.busy.size; ++i) {
        for (std::uint64_t busy = rows.busy.bits[i]; busy != 0; busy &= busy - 1) {
            const std::int64_t w = 64 * i + std::countr_zero(busy);
            const std::uint64_t active = rows.active(w) & window.mask(w), here = rows.row[0][w];
            count_hits(w, (here ^ bits_after(rows.row[0], w)) & window.mask(w), here ^ rows.row[1][w], here ^ rows.row[2][w], place);
            if (active == 0) continue;
            mark_word(place.cell_words, w);
            const __m512i patterns = wide_patterns(rows, w);
            const __m512i low = _mm512_permutex2var_epi8(first, patterns, second);
            const __m512i high = _mm512_permutex2var_epi8(third, patterns, fourth);
            const __m512i triangles = _mm512_maskz_mov_epi8(active, _mm512_mask_blend_epi8(_mm512_movepi8_mask(patterns), low, high));
            sums = _mm512_add_epi64(sums, _mm512_sad_epu8(triangles, _mm512_setzero_si512()));
            for (std::uint64_t others = active & ~_mm512_test_epi8_mask(triangles, triangles); others != 0; others &= others - 1) {
                const int bit = std::countr_zero(others);
                int pattern = 0;
                for (int r = 0; r < 4; ++r) {
                    const std::uint64_t* bits = rows.row[static_cast<std::size_t>(r)];
                    pattern |= static_cast<int>((bits[w] >> bit & 1) | (bits_after(bits, w) >> bit & 1) << 1) << 2 * r;
                }
                rest(64 * w + bit, pattern);
            }
        }
    }
    alignas(64) std::array<std::int64_t, 8> parts;
    _mm512_store_si512(parts.data(), sums);
    for (const std::int64_t part : parts) place.triangle += part;
}

/// write_plain().
template <class Rest>
ISOATLAS_WIDE_512 void write_wide(const CellRow<4>& rows, const CellWindow& window, const PlainCells& cells, const HitCounters& first,
                                  std::array<std::int64_t, 3>* triangle, const std::array<std::int64_t, 3>* end, Rest&& rest) {
    constexpr std::ptrdiff_t kWritten = 6;  // triangles, the last one not whole: what two vectors overwrite
    const __m512i one = _mm512_set1_epi64(1);
    // One by one: a vector cannot be loaded while the numbers that it is made of are being stored.
    __m512i next = _mm512_set_epi64(first[7], first[6], first[5], first[4], first[3], first[2], first[1], first[0]);
    alignas(64) std::array<std::uint8_t, 64> patterns;
    for (std::int64_t i = 0; i < rows.busy.size; ++i) {
        for (std::uint64_t busy = rows.busy.bits[i]; busy != 0; busy &= busy - 1) {
            const std::int64_t w = 64 * i + std::countr_zero(busy);
            std::uint64_t active = rows.active(w) & window.mask(w);
            if (active == 0) continue;
            _mm512_store_si512(patterns.data(), wide_patterns(rows, w));
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

namespace isoatlas {

/// count_plain(), as fast as it gets here.
template <class Rest>
void count_plain_cells(const CellRow<4>& rows, const CellWindow& window, const PlainCells& cells, RowPlace& place, Rest&& rest) {
#if ISOATLAS_HAS_WIDE_512
    if (kHasWide512) return count_wide(rows, window, cells, place, rest);
#endif
    count_plain(rows, window, cells, place, rest);
}

/// write_plain(), as fast as it gets here.
template <class Rest>
void write_plain_cells(const CellRow<4>& rows, const CellWindow& window, const PlainCells& cells, const HitCounters& first,
                       std::array<std::int64_t, 3>* triangle, const std::array<std::int64_t, 3>* end, Rest&& rest) {
#if ISOATLAS_HAS_WIDE_512
    if (kHasWide512) return write_wide(rows, window, cells, first, triangle, end, rest);
#endif
    write_plain(rows, window, cells, first, triangle, end, rest);
}

}  // namespace isoatlas
