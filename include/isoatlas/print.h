// A surface made fit for a 3D printer.
#pragma once

#include <array>
#include <cstdint>

#include "isoatlas/surface.h"

namespace isoatlas {

struct PrintOptions {
    double millimetres = 1;  ///< of a unit of length of the surface
    double speck = 1e-3;     ///< pieces that enclose less than this part of what the largest one encloses are dropped
};

struct PrintReport {
    std::int64_t pieces = 0;          ///< that are left: closed shells that share no point
    std::int64_t specks = 0;          ///< pieces that were dropped
    double largest_speck = 0;         ///< volume of the largest of these, mm3
    double volume = 0;                ///< of what is left, mm3
    std::array<double, 3> size_mm{};  ///< of the box around it
};

/// Drops specks and scales the points to millimetres (Surface::unit is "mm" then). surface: closed, of outer shells alone: inside walls the
/// volume of a piece would be taken for solid. Throws Error{usage} for curves, open surfaces, and options out of range. Cost: O(surface).
PrintReport prepare_for_print(Surface& surface, const PrintOptions& options = {});

}  // namespace isoatlas
