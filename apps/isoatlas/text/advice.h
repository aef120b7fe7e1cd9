// The library says why it failed and what would help, in words of its API; here that becomes options of the command line.
#pragma once

#include <isoatlas/error.h>

namespace isoatlas::cli {

/// The same error with the next step of somebody who types commands. Errors without a reason that has options stay.
[[nodiscard]] Error with_options(const Error& error);

}  // namespace isoatlas::cli
