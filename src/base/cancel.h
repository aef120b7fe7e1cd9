// Where a long call looks whether its caller still wants the answer.
#pragma once

#include "isoatlas/context.h"
#include "isoatlas/error.h"

namespace isoatlas {

/// Throws Error{cancelled} when he does not.
inline void stop_if_cancelled(const Context& context) {
    if (context.cancelled && context.cancelled()) throw Error(ErrorKind::cancelled, {.what = "cancelled"});
}

}  // namespace isoatlas
