// A store, open for one polarity or for both.
#pragma once

#include "isoatlas/atlas.h"

namespace isoatlas {

struct StoreSides {
    const Atlas& main;           ///< that of the page; of both: of high values
    const Atlas* low = nullptr;  ///< of both: the same store, open for objects of low values

    [[nodiscard]] bool has_both() const { return low != nullptr; }
    [[nodiscard]] const Atlas& of(Polarity polarity) const { return has_both() && polarity == Polarity::low ? *low : main; }
};

}  // namespace isoatlas
