// A triangle mesh with positions of integers in the bytes of Draco.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace isoatlas {

/// Edgebreaker; the decoder gives the points and triangles in another order. The same bytes for the same mesh.
[[nodiscard]] std::vector<std::byte> draco_mesh(std::span<const std::array<std::int32_t, 3>> points,
                                                std::span<const std::array<std::uint32_t, 3>> triangles);

}  // namespace isoatlas
