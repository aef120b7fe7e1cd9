// Ambiguous faces of a slice, as one byte per voxel, and the type of an ambiguous face inside one of its cells.
//
// Byte of voxel a: bits 2o, 2o+1 for the face of orientation o whose corner a is the voxel: bit 2o when a, c are the Highs, 2o+1 when b, d
// are.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "field/cell.h"
#include "field/face.h"
#include "field/grid.h"
#include "field/order.h"

namespace isoatlas {

inline constexpr std::uint8_t kFaceBits[3] = {0b000011, 0b001100, 0b110000};

/// Writes the face bytes of slice z. The xz and yz faces need slice z+1: they are left out when with_next is false.
/// Returns false when no face of the slice is ambiguous.
template <class T>
bool faces_of_slice(const GridView<T>& grid, std::int64_t z, bool with_next, std::span<std::uint8_t> faces);

/// A cell with all it takes to classify its ambiguous faces: corner values and voxels, face values.
struct CellElements {
    alignas(16) std::array<double, 8> value;  ///< of corner k
    std::array<std::int64_t, 8> voxel;        ///< of corner k
    unsigned ambiguous;                       ///< bit f: face f is ambiguous
    unsigned bd_high;                         ///< bit f: and b, d are its Highs
    std::array<double, 6> face_value;         ///< disambiguation value of an ambiguous face
    bool has_small_integers = false;          ///< corner values are known to be integers of at most 16 bits: products of three are exact
};

/// Fills in which faces of a cell are ambiguous, and how, from its corners.
void mark_ambiguous_faces(CellElements& cell);

/// The same, and the face values.
void find_ambiguous_faces(CellElements& cell);

/// Face values rounded down (field/face.h).
void find_face_values(CellElements& cell);

/// Order of two elements of one cell: corners 0..7, ambiguous face f is 8 + f.
bool element_below(const CellElements& cell, int element, int other);

/// Default types of the ambiguous faces of one cell (docs/theory/2-critical-elements.md#face-points): bit f set = type H, the Highs are
/// joined in this cell by elements above F; clear = type L, the Lows are joined below.
std::uint8_t default_face_types(const CellElements& cell, const CellTable& table = cell_table());

}  // namespace isoatlas
