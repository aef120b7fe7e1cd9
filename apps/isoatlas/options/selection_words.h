// Options of a selection: --keep, --top P%, --min-volume, ...
#pragma once

#include <functional>
#include <string>

#include "options/arguments.h"

namespace isoatlas::cli {

/// As typed.
struct TypedSelection {
    std::string top, persistence;
    std::int64_t keep = 0;
    double min_voxels = 0, min_volume = 0, min_hypervolume = 0;
};

/// given: was an option given? Throws Error{usage}.
void convert_selection(const std::function<bool(const char*)>& given, const TypedSelection& typed, Arguments& arguments);

}  // namespace isoatlas::cli
