// extract --simplify, --simplify-error, --triangles
#pragma once

#include <string>

#include <isoatlas/isoatlas.h>

#include "options/arguments.h"
#include "text/document.h"

namespace isoatlas::cli {

/// What was simplified, of all surfaces together.
struct Simplification {
    SimplificationArguments asked;
    std::int64_t triangles_before = 0, triangles = 0;
    double distance = 0;  ///< of the surfaces from the exact ones, at most
    DistanceUnit unit = DistanceUnit::voxel;
    std::string length_unit;  ///< of physical distances; empty: unknown
};
[[nodiscard]] Simplification simplification_of(const Arguments& arguments);

/// Simplifies a surface of the volume and adds what was done. Curves (2D): Error{usage}.
void simplify(Surface& surface, const VolumeInfo& info, Simplification& sum, const Context& context);

/// "simplified from 64990 triangles to 2244 (3.5 %), within 0.5 voxels, with the same topology"
[[nodiscard]] std::string simplification_text(const Simplification& simplification);
[[nodiscard]] Json simplification_json(const Simplification& simplification);

}  // namespace isoatlas::cli
