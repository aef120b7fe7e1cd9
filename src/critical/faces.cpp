#include "critical/faces.h"

#include <algorithm>
#include <bit>
#include <tuple>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace isoatlas {
namespace {

// Voxel numbers ascend a < b < d < c, hence which comparisons are strict (field/face.h). No branches: vector code.
template <class T>
inline std::uint8_t diagonals(T a, T b, T c, T d) {
    const bool ac = (a > b) & (a > d) & (c >= b) & (c >= d);
    const bool bd = (b >= a) & (b > c) & (d >= a) & (d > c);
    return static_cast<std::uint8_t>(ac | bd << 1);
}

template <class T>
void faces_of_row(const T* r00, const T* r10, const T* r01, const T* r11, std::int64_t n, std::uint8_t* __restrict faces) {
    // r<dy><dz>: rows of the cell row; missing rows repeat r00, which makes no face ambiguous.
    for (std::int64_t x = 0; x + 1 < n; ++x) {
        faces[x] = static_cast<std::uint8_t>(diagonals(r00[x], r00[x + 1], r10[x + 1], r10[x]) |
                                             diagonals(r00[x], r00[x + 1], r01[x + 1], r01[x]) << 2 |
                                             diagonals(r00[x], r10[x], r11[x], r01[x]) << 4);
    }
    faces[n - 1] = static_cast<std::uint8_t>(diagonals(r00[n - 1], r10[n - 1], r11[n - 1], r01[n - 1]) << 4);
}

bool any_set(std::span<const std::uint8_t> bytes) {
    std::uint8_t all = 0;
    for (const std::uint8_t byte : bytes) all |= byte;
    return all != 0;
}

/// Second part of the key of face f of a cell (field/order.h).
std::int64_t second_key(const CellElements& cell, int f) {
    const std::array<int, 4>& c = kFaceCorners[f];
    const int low = cell.bd_high >> f & 1 ? 0 : 1;
    std::int64_t key = -1;
    for (const int corner : {c[low], c[low + 2]}) {
        if (cell.value[corner] == cell.face_value[f]) key = std::max(key, 2 * cell.voxel[corner] + 1);
    }
    return key;
}

std::int64_t face_number(const CellElements& cell, int f) { return 3 * cell.voxel[kFaceCorners[f][0]] + f / 2; }

bool face_above_face(const CellElements& cell, int g, int f) {
    if (cell.face_value[g] != cell.face_value[f]) return cell.face_value[g] > cell.face_value[f];
    const std::int64_t g2 = second_key(cell, g), f2 = second_key(cell, f);
    return g2 != f2 ? g2 > f2 : face_number(cell, g) > face_number(cell, f);
}

inline FaceCorners corners_of(const CellElements& cell, int f) {
    const std::array<int, 4>& c = kFaceCorners[f];
    const int high = static_cast<int>(cell.bd_high >> f & 1);
    return {cell.value[c[1 - high]], cell.value[c[3 - high]], cell.value[c[high]], cell.value[c[high + 2]]};
}

struct Comparison {
    int above, equal;  // bit k: corner k
};

Comparison compare_corners(const std::array<double, 8>& value, double s) {
    Comparison result{0, 0};
#ifdef __SSE2__
    const __m128d threshold = _mm_set1_pd(s);
    for (int k = 0; k < 8; k += 2) {
        const __m128d pair = _mm_load_pd(value.data() + k);
        result.above |= _mm_movemask_pd(_mm_cmpgt_pd(pair, threshold)) << k;
        result.equal |= _mm_movemask_pd(_mm_cmpeq_pd(pair, threshold)) << k;
    }
#else
    for (int k = 0; k < 8; ++k) {
        result.above |= (value[k] > s) << k;
        result.equal |= (value[k] == s) << k;
    }
#endif
    return result;
}

int corners_above_face(const CellElements& cell, int f) {
    auto [above, equal] = compare_corners(cell.value, cell.face_value[f]);
    if (equal == 0) return above;
    const std::int64_t key = second_key(cell, f);
    for (int k = 0; k < 8; ++k) {
        if (equal >> k & 1 && 2 * cell.voxel[k] > key) above |= 1 << k;
    }
    return above;
}

}  // namespace

template <class T>
bool faces_of_slice(const GridView<T>& grid, std::int64_t z, bool with_next, std::span<std::uint8_t> faces) {
    const std::int64_t n = grid.extent.size[0], rows = grid.extent.size[1];
    for (std::int64_t y = 0; y < rows; ++y) {
        const bool last = y + 1 == rows;
        const T* r00 = grid.row(y, z);
        const T* r10 = last ? r00 : grid.row(y + 1, z);
        const T* r01 = with_next ? grid.row(y, z + 1) : r00;
        const T* r11 = !with_next ? r10 : last ? r01 : grid.row(y + 1, z + 1);
        faces_of_row(r00, r10, r01, r11, n, faces.data() + y * n);
    }
    return any_set(faces);
}

void mark_ambiguous_faces(CellElements& cell) {
    cell.ambiguous = cell.bd_high = 0;
    for (int f = 0; f < 6; ++f) {
        const std::array<int, 4>& corner = kFaceCorners[f];
        const Diagonal highs = high_diagonal(cell.value[corner[0]], cell.value[corner[1]], cell.value[corner[2]], cell.value[corner[3]]);
        if (highs == Diagonal::none) continue;
        cell.ambiguous |= 1U << f;
        cell.bd_high |= unsigned{highs == Diagonal::bd} << f;
    }
}

void find_ambiguous_faces(CellElements& cell) {
    mark_ambiguous_faces(cell);
    find_face_values(cell);
}

void find_face_values(CellElements& cell) {
    for (unsigned rest = cell.ambiguous; rest != 0; rest &= rest - 1) {
        const int f = std::countr_zero(rest);
        cell.face_value[f] = rounded_face_value(corners_of(cell, f));
    }
}

bool element_below(const CellElements& cell, int element, int other) {
    const auto key = [&cell](int e) {
        return e < 8 ? std::tuple(cell.value[e], 2 * cell.voxel[e], std::int64_t{0})
                     : std::tuple(cell.face_value[e - 8], second_key(cell, e - 8), face_number(cell, e - 8));
    };
    return key(element) < key(other);
}

std::uint8_t default_face_types(const CellElements& cell, const CellTable& table) {
    std::uint8_t types = 0;
    for (unsigned rest = cell.ambiguous; rest != 0; rest &= rest - 1) {
        const int f = std::countr_zero(rest);
        const int above = corners_above_face(cell, f);
        int joined = 0;  // of the other faces that are split at this cut; such a face is ambiguous
        for (unsigned others = table.split[above] & ~(1u << f); others != 0; others &= others - 1) {
            const int g = std::countr_zero(others);
            joined |= face_above_face(cell, g, f) << g;
        }
        types |= static_cast<std::uint8_t>(table.highs_joined[64 * above + joined] & 1 << f);
    }
    return types;
}

template bool faces_of_slice(const GridView<std::uint8_t>&, std::int64_t, bool, std::span<std::uint8_t>);
template bool faces_of_slice(const GridView<std::int8_t>&, std::int64_t, bool, std::span<std::uint8_t>);
template bool faces_of_slice(const GridView<std::uint16_t>&, std::int64_t, bool, std::span<std::uint8_t>);
template bool faces_of_slice(const GridView<std::int16_t>&, std::int64_t, bool, std::span<std::uint8_t>);
template bool faces_of_slice(const GridView<std::uint32_t>&, std::int64_t, bool, std::span<std::uint8_t>);
template bool faces_of_slice(const GridView<std::int32_t>&, std::int64_t, bool, std::span<std::uint8_t>);
template bool faces_of_slice(const GridView<float>&, std::int64_t, bool, std::span<std::uint8_t>);
template bool faces_of_slice(const GridView<double>&, std::int64_t, bool, std::span<std::uint8_t>);

}  // namespace isoatlas
