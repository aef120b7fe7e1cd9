#include "catalogue/page_mesh.h"

#include <algorithm>
#include <cmath>

#include "base/cancel.h"
#include "base/check.h"
#include "formats/common/base64.h"
#include "preview/coarse_surface.h"
#include "preview/collapse_edges.h"
#include "preview/wire_mesh.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kLeastBytes = 4000;
constexpr double kSteps = 8192;  ///< positions, along the diagonal: less than a pixel on a screen
constexpr double kFewer = 0.75;  ///< triangles of the next attempt

CoarseSurface reduced(const Surface& surface, std::size_t max, const Context& context) {
    CoarseSurface result{collapse_edges(surface, max, context), std::ssize(surface.triangles), true};
    ISOATLAS_DCHECK(has_same_topology(surface, result.surface));
    if (result.surface.triangles.size() <= max) return result;
    result.surface = coarse_surface(std::move(result.surface), max);
    result.keeps_topology = has_same_topology(surface, result.surface);
    return result;
}

double diagonal(const Surface& surface) {
    double sum = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto [low, high] = std::ranges::minmax(surface.points, {}, [axis](const Vec3& point) { return point[axis]; });
        sum += (high[axis] - low[axis]) * (high[axis] - low[axis]);
    }
    return std::sqrt(sum);
}

std::int64_t base64_size(const std::string& bytes) { return (std::ssize(bytes) + 2) / 3 * 4; }

}  // namespace

CoarseSurface coarse_for_page(const Surface& surface, const Context& context) { return reduced(surface, kMaxPageTriangles, context); }

PageMesh page_mesh(const CoarseSurface& coarse, std::int64_t max_bytes, const Context& context) {
    if (max_bytes < kLeastBytes || coarse.surface.triangles.empty()) return {};
    CoarseSurface now = coarse;
    const double step = diagonal(coarse.surface) / kSteps;
    if (!(step > 0)) return {};
    while (true) {
        const WireMesh packed = wire_mesh(now.surface, {.step = step, .distinct = true}, context);
        if (base64_size(packed.bytes) <= max_bytes)
            return {base64(std::as_bytes(std::span(packed.bytes))), packed.triangles, coarse.of,
                    now.keeps_topology && packed.without_area == 0};
        const double fits = static_cast<double>(max_bytes) / static_cast<double>(base64_size(packed.bytes));
        const double next = static_cast<double>(packed.triangles) * std::min(kFewer, fits);
        if (next < 32) return {};
        const bool kept = now.keeps_topology;
        now = reduced(now.surface, static_cast<std::size_t>(next), context);
        now.keeps_topology = now.keeps_topology && kept;
    }
}

std::vector<PageMesh> page_meshes(std::span<const CoarseSurface> surfaces, std::int64_t max_bytes, const Context& context) {
    std::vector<PageMesh> meshes;
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        stop_if_cancelled(context);
        meshes.push_back(page_mesh(surfaces[i], max_bytes / static_cast<std::int64_t>(surfaces.size() - i), context));
        max_bytes -= std::ssize(meshes.back().data);
    }
    return meshes;
}

}  // namespace isoatlas
