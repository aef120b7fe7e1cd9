// extract --coarser
#pragma once

#include <string>
#include <vector>

#include <isoatlas/isoatlas.h>

#include "options/arguments.h"
#include "text/document.h"

namespace isoatlas::cli {

/// What a file has beside the exact surfaces, of all of them together.
struct CoarserVersions {
    struct Version {
        std::int64_t triangles = 0;
        double distance = 0;  ///< from the exact surfaces, at most; in the unit of the volume
    };
    std::int64_t most = 0;  ///< versions of a surface
    std::vector<Version> list{};
    std::string length_unit{};  ///< empty: unknown
};

/// --coarser: of a surface in .glb, nothing else that changes it. Throws Error{usage}.
void check_coarser(const Arguments& arguments);

/// Coarser versions of a surface of the volume; adds what was made. Curves (2D): Error{usage}.
[[nodiscard]] std::vector<SimplifiedSurface> coarser_versions(const Surface& surface, const VolumeInfo& info, CoarserVersions& sum,
                                                              const Context& context);

/// "coarser versions of 3568 triangles within 0.25 mm, 892 within 1 mm, with the same topology"
[[nodiscard]] std::string coarser_text(const CoarserVersions& versions);
/// Null: none were asked for.
[[nodiscard]] Json coarser_json(const CoarserVersions& versions);

}  // namespace isoatlas::cli
