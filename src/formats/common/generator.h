// Name and version of the program, written into files.
#pragma once

#include "isoatlas/version.h"

namespace isoatlas {

inline constexpr const char* kVersion = ISOATLAS_VERSION;
inline constexpr const char* kGenerator = "isoatlas " ISOATLAS_VERSION;

}  // namespace isoatlas
