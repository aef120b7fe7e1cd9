// Interpolant: how samples are connected inside cells.
#pragma once

#include <cstdint>

namespace isoatlas {

/// How samples are connected inside cells. `faces`: 6-neighbours plus face disambiguation points (the dissertation's connectivity).
/// `trilinear`: exactly as the trilinear interpolant connects them, tunnels through the interior of cells included. The same in 2D.
enum class Interpolant : std::uint8_t { faces, trilinear };
[[nodiscard]] const char* name_of(Interpolant interpolant);

}  // namespace isoatlas
