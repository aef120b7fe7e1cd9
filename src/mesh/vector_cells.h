// plain_cells.h by the widest vectors of the processor.
#pragma once

#include "mesh/cells_avx2.h"
#include "mesh/cells_avx512.h"

namespace isoatlas {

/// count_plain().
template <class Rest>
void count_plain_cells(const CellRow<4>& rows, const CellWindow& window, const PlainCells& cells, RowOffsets& place, Rest&& rest) {
#if ISOATLAS_HAS_AVX512
    if (kHasAvx512) return count_avx512(rows, window, cells, place, rest);
    if (kHasFused) return count_avx2(rows, window, cells, place, rest);
#endif
    count_plain(rows, window, cells, place, rest);
}

/// write_plain().
template <class Rest>
void write_plain_cells(const CellRow<4>& rows, const CellWindow& window, const PlainCells& cells, const HitCounters& first,
                       std::array<std::int64_t, 3>* triangle, const std::array<std::int64_t, 3>* end, Rest&& rest) {
#if ISOATLAS_HAS_AVX512
    if (kHasAvx512) return write_avx512(rows, window, cells, first, triangle, end, rest);
    if (kHasFused) return write_avx2(rows, window, cells, first, triangle, rest);
#endif
    write_plain(rows, window, cells, first, triangle, end, rest);
}

}  // namespace isoatlas
