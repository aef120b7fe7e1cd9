// The classes of the samples of one brick, as bits.
#pragma once

#include <array>
#include <cstdint>

#include "field/brick_grid.h"

namespace isoatlas {

class HighBits;

inline constexpr std::int64_t kBrickRows = kBrickSize[1] * kBrickSize[2];

/// Bit x of row y + 8 z: is the sample High? Beyond the size of a smaller brick: zeros.
using BrickBits = std::array<std::uint16_t, static_cast<std::size_t>(kBrickRows)>;

/// A bit for every sample of a brick.
[[nodiscard]] BrickBits whole_brick(const Index3& size);

/// samples: of the slot of a brick (bricks/brick_layout.h), row by row, all slices of a full brick. min: smallest value of a High sample.
/// T: a sample type.
template <class T>
[[nodiscard]] BrickBits bits_of_brick(const T* samples, const Index3& size, T min);

/// Writes them at the position of the brick, overwriting.
void put_brick(const BrickBits& bits, const Box& box, HighBits& high);

/// Layers of a brick along each axis that have Highs, and that have Lows; samples beyond a smaller brick are Low.
struct BrickFaces {
    std::array<std::uint16_t, 3> high{}, low{};
};
[[nodiscard]] BrickFaces sides_of(const BrickBits& bits, const Index3& size);

}  // namespace isoatlas
