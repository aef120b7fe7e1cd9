// Name and version of the program, written into files.
#pragma once

namespace isoatlas {

inline constexpr const char* kVersion = "0.1.0";
inline constexpr const char* kGenerator = "isoatlas 0.1.0";

}  // namespace isoatlas
