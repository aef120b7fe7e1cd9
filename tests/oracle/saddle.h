// The saddles of a trilinear function inside one cell, in 1,000 bits: slow and obvious. For tests of src/critical.
#pragma once

#include <array>
#include <optional>

#include "oracle/rational.h"

namespace oracle {

struct CellSaddle {
    double value;     ///< the greatest double at most the exact one
    bool is_certain;  ///< false: so close to a double, or to the border of the cell, that 1,000 bits do not tell
};

/// The critical point strictly inside the cell at which High regions join (else: Low regions), found as the text of the theory says:
/// gradient zero, and the product of the mixed second derivatives positive (negative). Corner k = x + 2y + 4z.
std::optional<CellSaddle> saddle_in_cell(const std::array<double, 8>& corner, bool joins_highs);

}  // namespace oracle
