// Registry of the files with temporary names that this process is writing; isoatlas/output_file.h removes them when a signal ends it.
#pragma once

#include <string>

namespace isoatlas {

/// From before such a file is created until it has its name, or is removed.
void note_unfinished(const std::string& path);
void forget_unfinished(const std::string& path) noexcept;

}  // namespace isoatlas
