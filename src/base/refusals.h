// What the operating system refuses, as errors that say what to do.
#pragma once

#include <string>

#include "isoatlas/error.h"

namespace isoatlas {

/// Error{resource}: no more threads. reason: as the system says it.
[[nodiscard]] Error threads_refused(const std::string& reason);

}  // namespace isoatlas
