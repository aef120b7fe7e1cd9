#include "data/simplify.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

namespace isoatlas::cli {

Simplification simplification_of(const Arguments& arguments) {
    const SimplificationArguments& asked = arguments.simplification;
    return {.asked = asked, .unit = asked.length ? DistanceUnit::physical : DistanceUnit::voxel, .length_unit = {}};
}

void simplify(Surface& surface, const VolumeInfo& info, Simplification& sum, const Context& context) {
    if (!surface.segments.empty()) {
        throw Error(ErrorKind::usage, {.file = info.path,
                                       .what = "curves of a 2D volume are not simplified",
                                       .next = "omit --simplify, --simplify-error and --triangles"});
    }
    SimplificationOptions options;
    options.unit = sum.unit;
    options.max_distance = sum.asked.voxels   ? *sum.asked.voxels
                           : sum.asked.length ? *sum.asked.length
                                              : std::numeric_limits<double>::infinity();
    options.triangles = sum.asked.triangles.value_or(0);
    sum.length_unit = surface.unit;
    sum.triangles_before += static_cast<std::int64_t>(surface.triangles.size());
    SimplifiedSurface simplified = simplify_surface(surface, info.geometry, info.extent, options, context);
    surface = std::move(simplified.surface);
    sum.triangles += static_cast<std::int64_t>(surface.triangles.size());
    sum.distance = std::max(sum.distance, simplified.distance);
}

std::string simplification_text(const Simplification& simplification) {
    const double percent = 100 * static_cast<double>(simplification.triangles) / static_cast<double>(simplification.triangles_before);
    const std::string length = simplification.length_unit.empty() ? "" : " " + simplification.length_unit;
    return fmt::format("simplified from {} triangles to {} ({:.2g} %), within {:.3g}{} of the exact surface, with the same topology",
                       simplification.triangles_before, simplification.triangles, percent, simplification.distance,
                       simplification.unit == DistanceUnit::voxel ? " voxels" : length);
}

Json simplification_json(const Simplification& simplification) {
    Json json{{"triangles_before", simplification.triangles_before}, {"distance", simplification.distance}};
    json["distance_unit"] = simplification.unit == DistanceUnit::voxel ? "voxel" : "physical";
    return json;
}

}  // namespace isoatlas::cli
