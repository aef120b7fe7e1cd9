#include "server/fewer_triangles.h"

#include <algorithm>

#include "formats/common/byte_writer.h"
#include "isoatlas/error.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kTimes = 6;  ///< memory of a triangle that is simplified, in that of one that is written

}  // namespace

FewerTriangles::FewerTriangles(QueryParameters& words) : voxels_(words.number("simplify", 0)) {
    if (voxels_ && *voxels_ == 0)
        throw Error(ErrorKind::usage, {.where = "simplify",
                                       .what = "a surface is not simplified within 0 voxels",
                                       .expected = "a number above 0",
                                       .next = "omit it for the exact surface"});
}

std::int64_t FewerTriangles::most_of(std::int64_t triangles) const { return voxels_ ? triangles / kTimes : triangles; }

void FewerTriangles::apply(Surface& surface, const VolumeInfo& info, const Context& context) {
    if (!voxels_) return;
    SimplifiedSurface simplified = simplify_surface(surface, info.geometry, info.extent, {.max_distance = *voxels_}, context);
    surface = std::move(simplified.surface);
    triangles_ += static_cast<std::int64_t>(surface.triangles.size());
    distance_ = std::max(distance_, simplified.distance);
}

Response FewerTriangles::told(Response response) const {
    if (!voxels_) return response;
    response.headers["X-Distance"] = number_text(distance_);
    response.headers["X-Triangles"] = std::to_string(triangles_);
    return response;
}

}  // namespace isoatlas
