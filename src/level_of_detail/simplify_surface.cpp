// The order of collapses: passes over blocks with a growing limit of the cost and growing, shifted blocks, so that the order is nearly
// that of the cost over the whole surface, whatever the blocks; at last one block holds all that is left.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/cancel.h"
#include "base/parallel.h"
#include "geometry/deviation.h"
#include "isoatlas/environment.h"
#include "isoatlas/error.h"
#include "isoatlas/level_of_detail.h"
#include "level_of_detail/collapse_block.h"
#include "level_of_detail/normal_near.h"
#include "level_of_detail/surface_frame.h"
#include "level_of_detail/without_points.h"

namespace isoatlas {
namespace {

constexpr std::size_t kMaxTriangles = std::size_t{1} << 30;  // corners and pieces have numbers of 32 bits

struct Pass {
    double edge;      ///< of a block, in units of distance; infinity: one block
    double shift;     ///< of the blocks
    double max_cost;  ///< infinity: any
};

/// step: a sample step. tolerance: the distance that decides which costs are small.
std::vector<Pass> passes(double step, double tolerance) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    std::vector<Pass> all;
    double cost = tolerance * tolerance * step * step / 256;
    for (const double edge : {32.0, 32.0, 48.0, 48.0, 64.0, 64.0, 96.0}) {
        const bool is_shifted = all.size() % 2 == 1;
        all.push_back({edge * step, is_shifted ? edge * step / 2 : 0, cost});
        cost *= 8;
    }
    all.push_back({kInfinity, 0, kInfinity});
    return all;
}

/// The points that the triangles use, in their order.
Surface remaining(const Surface& surface, const SurfaceState& state, const OriginalSurface& original) {
    const CollapsibleMesh& mesh = state.mesh;
    Surface result = without_points(surface);
    std::vector<std::int64_t> place(surface.points.size(), -1);
    for (std::uint32_t point = 0; point < mesh.points(); ++point) {
        if (!mesh.has_point(point)) continue;
        place[point] = static_cast<std::int64_t>(result.points.size());
        result.points.push_back(state.points[point]);
        if (!surface.normals.empty()) {
            const bool has_moved = state.scaled[point] != original.point(point);
            result.normals.push_back(has_moved ? normal_near(original, surface.normals, state.scaled[point], state.frame->step())
                                               : surface.normals[point]);
        }
        if (!surface.object.empty()) result.object.push_back(surface.object[point]);
        if (!surface.contour.empty()) result.contour.push_back(surface.contour[point]);
    }
    for (std::uint32_t t = 0; t < mesh.triangles(); ++t) {
        if (!mesh.has_triangle(t)) continue;
        const auto [a, b, c] = mesh.triangle(t);
        result.triangles.push_back({place[a], place[b], place[c]});
    }
    return result;
}

SurfaceState state_of(const Surface& surface, const SurfaceFrame& frame) {
    SurfaceState state{.mesh = CollapsibleMesh(surface.triangles, surface.points.size()),
                       .frame = &frame,
                       .scaled = Array<Vec3>(frame.scaled().begin(), frame.scaled().end()),
                       .points = surface.points,
                       .quadrics = Array<Quadric<float>>(surface.points.size(), Quadric<float>{}),
                       .faces = frame.faces(),
                       .locked = Array<std::uint8_t>(surface.points.size(), 0),
                       .failed = Array<std::uint8_t>(surface.triangles.size(), 0),
                       .distance = {}};
    for (std::uint32_t point = 0; point < state.points.size(); ++point) set_quadric(state, point);
    mark_rims(state.mesh, state.faces);
    return state;
}

void require_options(const Surface& surface, const SimplificationOptions& options) {
    if (!(options.max_distance > 0)) {
        throw Error(ErrorKind::usage, {.what = "the greatest distance of a simplified surface is not positive", .expected = "more than 0"});
    }
    if (options.triangles < 0) {
        throw Error(ErrorKind::usage, {.what = "the number of triangles is negative", .expected = "0 or more"});
    }
    if (surface.triangles.size() >= kMaxTriangles) {
        throw Error(ErrorKind::resource, {.what = "the surface has " + std::to_string(surface.triangles.size()) + " triangles",
                                          .expected = "fewer than 2^30 triangles",
                                          .next = "simplify its objects one by one"});
    }
}

/// tolerance: the distance that decides which costs are small.
void run_passes(SurfaceState& state, const SimplificationOptions& options, double tolerance, const Context& context) {
    auto left = static_cast<std::int64_t>(state.mesh.triangles());
    const std::vector<Pass> all = passes(state.frame->step(), tolerance);
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Pass& pass = all[i];
        stop_if_cancelled(context);
        context.report("simplify", static_cast<int>(i), static_cast<int>(all.size()), 0);
        const std::int64_t least = std::isinf(pass.edge) ? options.triangles : 2 * options.triangles;
        if (left <= least) continue;
        BoundingBox bounds;
        for (const Vec3& p : state.scaled) bounds.add(p);
        const BlockGrid grid(bounds, pass.edge, pass.shift);
        const std::vector<SurfaceBlock> blocks = blocks_of(state, grid);
        std::vector<std::int64_t> gone(blocks.size(), 0);
        const CallerLooks stop_if_asked(context);
        for_each_block(context.threads, static_cast<std::int64_t>(blocks.size()), [&](std::int64_t block) {
            stop_if_asked();
            const auto inside = static_cast<double>(blocks[block].inside.size());
            const auto kept = static_cast<std::int64_t>(inside * static_cast<double>(least) / static_cast<double>(left));
            gone[block] = collapse_block(state, blocks[block], {.max_cost = pass.max_cost, .triangles = kept}, stop_if_asked);
        });
        left -= std::accumulate(gone.begin(), gone.end(), std::int64_t{0});
    }
}

double measured_distance(const Surface& surface, const SurfaceFrame& frame, const Surface& simplified, const Context& context) {
    constexpr double kTolerance = 1e-3;  // of a step
    Array<Vec3> scaled(simplified.points.size());
    for (std::size_t i = 0; i < scaled.size(); ++i) scaled[i] = frame.scaled(simplified.points[i]);
    return measure_deviation({frame.scaled(), surface.triangles}, {scaled, simplified.triangles}, {.tolerance = kTolerance * frame.step()},
                             context)
        .upper();
}

}  // namespace

SimplifiedSurface simplify_surface(const Surface& surface, const Geometry& geometry, const Extent& extent,
                                   const SimplificationOptions& options, const Context& context) {
    const EnvironmentScope scope(context);
    require_options(surface, options);
    const auto full = static_cast<std::int64_t>(surface.triangles.size());
    if (full <= options.triangles || surface.triangles.empty()) return {surface, 0};
    const SurfaceFrame frame(surface, geometry, extent, options.unit);
    const bool is_bounded = std::isfinite(options.max_distance);
    const double cell = is_bounded ? std::max(frame.step(), options.max_distance) : frame.step();
    const OriginalSurface original(frame.scaled(), surface.triangles, cell);
    SurfaceState state = state_of(surface, frame);
    if (is_bounded) {
        state.distance.original = &original;
        state.distance.max = options.max_distance;
        state.distance.to_original.assign(surface.triangles.size(), 0);
        state.distance.tracked = TrackedPieces(surface.triangles.size());
    }
    run_passes(state, options, is_bounded ? options.max_distance : frame.step(), context);
    SimplifiedSurface result{remaining(surface, state, original), options.max_distance};
    if (!is_bounded) result.distance = measured_distance(surface, frame, result.surface, context);
    return result;
}

}  // namespace isoatlas
