// Finite differences of the numbers of a box, of order 0, 1 or 2 along each axis.
//
// The size of a box: numbers along x, y, z; x fastest.
// Order 1 keeps the first number of a row, order 2 also the difference of the second one. Modular arithmetic, so lossless.
//
// In the literature: delta coding; order 1 along all three axes is the Lorenzo predictor (Ibarria et al., Out-of-core compression and
// decompression of large n-dimensional scalar fields, 2003).
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "isoatlas/index3.h"

namespace isoatlas {

using Orders = std::array<int, 3>;  ///< of the differences along x, y, z: 0, 1 or 2

template <class N>
void take_differences(std::span<N> numbers, const Index3& size, const Orders& orders);

/// Inverse.
template <class N>
void undo_differences(std::span<N> numbers, const Index3& size, const Orders& orders);

/// Storage order of the differences: the first one of all rows, the second one if the order along x is 2, then the rest of every row, which
/// groups numbers of similar size. Signed numbers are zigzag coded (0 -1 1 -2 ...), unless all orders are 0.
template <class N>
void arrange(std::span<const N> differences, const Index3& size, const Orders& orders, std::span<N> out);

/// Inverse.
template <class N>
void disarrange(std::span<N> arranged, const Index3& size, const Orders& orders, std::span<N> out);

}  // namespace isoatlas
