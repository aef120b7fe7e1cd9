// The store of a volume in the current folder: built when somebody wants to see what is in the volume, used again while it is of that.
#pragma once

#include <string>

#include "arguments.h"

namespace isoatlas::cli {

class Terminal;

/// scan.nii.gz, scan.nrrd and scan.atlas all give scan.
[[nodiscard]] std::string stem_of(const std::string& file);

/// scan.atlas.html and scan.html stand beside scan.atlas.
[[nodiscard]] std::string store_beside(const std::string& page);

/// Is there a store of arguments.file as it is now: newer than it, and with its samples? Two scans may have one name.
[[nodiscard]] bool is_fresh(const std::string& store, const Arguments& arguments);

/// arguments.file if it is a store; else `store`, built from it unless it is fresh.
[[nodiscard]] std::string store_for(const Arguments& arguments, Terminal& terminal, const std::string& store);

}  // namespace isoatlas::cli
