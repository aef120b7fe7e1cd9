// Exact predicates of the trilinear interpolant of one cell: slopes at face saddles, saddles inside, their values.
//
// For the few cells that doubles do not decide (critical/bodies.h, critical/body_saddle.h). Any finite corner values.
// Corner values are integers times a power of two; signs of polynomials in them are signs of integers. Cost: 0.1 microseconds where
// the corners differ by less than 2^38 of their unit (products fit 128 bits), else a few microseconds.
//
// In the literature: exact predicates behind floating-point filters (Shewchuk, Adaptive precision floating-point arithmetic, 1997).
#pragma once

#include <array>

namespace isoatlas {

using CellValues = std::array<double, 8>;

/// Which of the two critical points of the trilinear function: High regions join there, or Low regions do (docs/theory/6-interior.md).
enum class SaddleKind : unsigned char { joins_highs, joins_lows };

/// Sign (-1, 0, 1) of the derivative into the cell at the saddle of its ambiguous face f.
int exact_side_sign(const CellValues& value, int f);

/// Is there a saddle of this kind strictly inside the cell?
bool exactly_has_saddle(const CellValues& value, SaddleKind kind);

/// Its value, rounded down (field/rounding.h); there must be one. guess: near it.
double exact_saddle_value(const CellValues& value, SaddleKind kind, double guess);

}  // namespace isoatlas
