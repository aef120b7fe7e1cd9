// A mesh against the exact surface of a volume or store: verify --against.
#pragma once

#include <string>

#include <isoatlas/isoatlas.h>

#include "data/sides.h"
#include "text/document.h"

namespace isoatlas::cli {

struct AgainstSurface {
    Json head;  ///< of the JSON document
    SimplifiedReport report;
    std::string distances;  ///< a line for reading; empty: nothing could be measured
};

/// arguments.mesh against the surface that `extract` writes of arguments.file with the same options. Throws Error: usage (which isovalue?
/// several isovalues), unsupported (curves of a 2D volume), as read_mesh(), as extract().
[[nodiscard]] AgainstSurface verify_against(const Arguments& arguments, Terminal& terminal);

}  // namespace isoatlas::cli
