// Errors for what the operating system refuses, with the next step.
#pragma once

#include <string>

#include "isoatlas/error.h"

namespace isoatlas {

/// Error{resource}: no more threads. reason: as the system says it.
[[nodiscard]] Error threads_refused(const std::string& reason);

}  // namespace isoatlas
