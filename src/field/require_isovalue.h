// What every function that takes an isovalue demands of it.
#pragma once

#include <cmath>

#include "isoatlas/error.h"

namespace isoatlas {

/// Throws Error{usage}: not a finite number.
inline void require_isovalue(double tau) {
    if (!std::isfinite(tau))
        throw Error(ErrorKind::usage, {.what = "the isovalue is not a finite number", .next = "give a finite isovalue"});
}

}  // namespace isoatlas
