// Surfaces as meshes: of the whole store, or of its levels of detail; the first one of a page is kept.
#include <algorithm>

#include "isoatlas/polarity.h"
#include "server/service.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kFirstTriangles = 20'000;  ///< max of the first request of a page (web/src/viewer/api/surfaces.ts)
constexpr std::int64_t kTriangleBytes = 128;      ///< of a triangle while a response is made
constexpr double kStepsOfVoxel = 64;              ///< steps of positions per voxel

/// The entry that every page shows first; null: none, or a cavity.
const NamedEntry* first_of(const StoreCatalogue& known) {
    return known.entries.empty() || known.entries.front().is_cavity ? nullptr : &known.entries.front();
}

}  // namespace

void Service::prepare(const Context& context) {
    Context own = context_;
    own.cancelled = [&] { return ended_ || (context.cancelled && context.cancelled()); };
    const NamedEntry* first = first_of(known(own));
    const StoreSides sides = store_state_.sides();
    if (first == nullptr || sides.main.info().extent.rank != 3) return;
    const Atlas& atlas = sides.of(first->polarity);
    SurfaceOptions options;
    options.ids = false;
    options.objects = {first->id};
    (void)first_.get(own, [&](const Context& shared) { return mesh_of(atlas, first->tau, options, kFirstTriangles, shared); });
}

bool Service::is_first(const Atlas& atlas, double tau, const SurfaceOptions& options, std::int64_t max) const {
    const StoreCatalogue* known = known_.there();
    const NamedEntry* first = known == nullptr ? nullptr : first_of(*known);
    if (first == nullptr || max != kFirstTriangles || first->polarity != polarity_of(atlas.info())) return false;
    const bool is_alone = options.objects == std::vector{first->id} && options.contours.empty() && options.shell == ShellChoice::all;
    return is_alone && tau == first->tau && !options.ids;
}

WireMesh Service::mesh_of(const Atlas& atlas, double tau, const SurfaceOptions& options, std::int64_t max, const Context& context) {
    const std::optional<SimplifiedSurface> level = levels_.at_most(atlas, options, tau, max);
    if (!level) return wire(extract(atlas, tau, options, context), max, context);
    WireMesh mesh = wire(level->surface, max, context);
    if (mesh.coarse) return mesh;  // reduced once more, without a promise
    mesh.coarse = level->distance > 0;
    mesh.distance = level->distance;
    return mesh;
}

std::int64_t Service::max_triangles() const { return std::min(memory_ / kTriangleBytes, kMaxShownTriangles); }

Surface Service::extract(const Atlas& atlas, double tau, SurfaceOptions options, const Context& context) const {
    options.max_triangles = max_triangles();
    return atlas.extract(tau, options, context);
}

WireMesh Service::wire(const Surface& surface, std::int64_t max, const Context& context) const {
    const double spacing = std::ranges::min(store_state_.sides().main.info().geometry.spacing);
    return wire_mesh(surface, {.step = spacing / kStepsOfVoxel, .max_triangles = max}, context);
}

}  // namespace isoatlas
