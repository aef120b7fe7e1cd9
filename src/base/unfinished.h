// Files with temporary names that this process is writing, for the moment when a signal ends it (isoatlas/output_file.h removes them).
#pragma once

#include <string>

namespace isoatlas {

/// From before there is such a file until it has its name, or is gone.
void note_unfinished(const std::string& path);
void forget_unfinished(const std::string& path) noexcept;

}  // namespace isoatlas
