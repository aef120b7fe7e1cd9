// The store that stands beside a volume: built when somebody wants to see what is in the volume, used again while it is newer.
#pragma once

#include <string>

#include "arguments.h"

namespace isoatlas::cli {

class Terminal;

/// scan.nii.gz, scan.nrrd and scan.atlas all give scan.
[[nodiscard]] std::string stem_of(const std::string& file);

/// scan.atlas.html and scan.html stand beside scan.atlas.
[[nodiscard]] std::string store_beside(const std::string& page);

/// Is there a store, of this file as it is now: newer than it?
[[nodiscard]] bool is_fresh(const std::string& store, const std::string& file);

/// arguments.file if it is a store; else `store`, built from it unless it is there and newer than the file.
[[nodiscard]] std::string store_for(const Arguments& arguments, Terminal& terminal, const std::string& store);

}  // namespace isoatlas::cli
