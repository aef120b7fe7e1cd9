// extract -o NAME.precomputed: a folder of meshes for Neuroglancer.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <isoatlas/isoatlas.h>

#include "options/arguments.h"
#include "text/document.h"

namespace isoatlas::cli {

[[nodiscard]] bool is_precomputed(const std::string& output);

/// Options that change surfaces or name a space do not apply to it. Throws Error{usage}.
void check_precomputed(const Arguments& arguments);

/// Of all segments together.
struct PrecomputedLevel {
    std::int64_t triangles = 0, fragments = 0;
    double distance = 0;  ///< from the exact surfaces, at most; voxels
};

/// A segment for each surface: 1, 2 ...; segments with fewer levels count with their last one. info: of their volume.
[[nodiscard]] std::vector<PrecomputedLevel> write_precomputed(const std::string& output, std::span<const NamedSurface> surfaces,
                                                              const VolumeInfo& info, const Context& context);

/// "levels of 120,000 triangles, 31,000 within 0.25 voxels, 8,100 within 0.75, with the same topology"
[[nodiscard]] std::string levels_text(std::span<const PrecomputedLevel> levels);
/// Null: there are none.
[[nodiscard]] Json levels_json(std::span<const PrecomputedLevel> levels);

}  // namespace isoatlas::cli
