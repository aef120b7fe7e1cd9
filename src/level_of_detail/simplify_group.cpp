// Notation: points have numbers of their own here, ascending as in the versions: first those of the group, then those of the triangles
// beside it. Triangles likewise; those beside the group never change, as their points are locked.
#include "level_of_detail/simplify_group.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "level_of_detail/collapse_block.h"
#include "level_of_detail/normal_near.h"

namespace isoatlas {
namespace {

class Numbering {
public:
    void add(std::span<const TriangleCorners> triangles) {
        const std::size_t known = points_.size();
        for (const TriangleCorners& t : triangles) {
            for (const std::int64_t point : t) {
                if (!std::binary_search(points_.begin(), points_.begin() + static_cast<std::ptrdiff_t>(first_end_), point))
                    points_.push_back(point);
            }
        }
        const auto begin = points_.begin() + static_cast<std::ptrdiff_t>(known);
        std::sort(begin, points_.end());
        points_.erase(std::unique(begin, points_.end()), points_.end());
        if (first_end_ == 0) first_end_ = points_.size();
    }
    [[nodiscard]] std::int64_t number(std::int64_t point) const {
        const auto middle = points_.begin() + static_cast<std::ptrdiff_t>(first_end_);
        auto found = std::lower_bound(points_.begin(), middle, point);
        if (found == middle || *found != point) found = std::lower_bound(middle, points_.end(), point);
        return found - points_.begin();
    }
    [[nodiscard]] std::span<const std::int64_t> points() const { return points_; }
    [[nodiscard]] std::size_t own() const { return first_end_; }

private:
    std::vector<std::int64_t> points_;
    std::size_t first_end_ = 0;
};

SurfaceState state_of(const Versions& versions, const Numbering& numbering, std::span<const TriangleCorners> triangles,
                      std::span<const std::uint8_t> is_locked) {
    const std::span<const std::int64_t> points = numbering.points();
    SurfaceState state{.mesh = CollapsibleMesh(triangles, points.size()),
                       .frame = &versions.frame(),
                       .scaled = Array<Vec3>(points.size()),
                       .points = Array<Vec3>(points.size()),
                       .quadrics = Array<Quadric<float>>(numbering.own(), Quadric<float>{}),
                       .faces = Array<std::uint16_t>(points.size()),
                       .locked = Array<std::uint8_t>(points.size(), 1),
                       .failed = Array<std::uint8_t>(triangles.size(), 0),
                       .distance = {}};
    for (std::size_t i = 0; i < points.size(); ++i) {
        state.scaled[i] = versions.scaled(points[i]);
        state.points[i] = versions.hierarchy().surface.points[static_cast<std::size_t>(points[i])];
        state.faces[i] = versions.faces(points[i]);
        if (i < numbering.own()) state.locked[i] = is_locked[static_cast<std::size_t>(points[i])];
    }
    for (std::uint32_t i = 0; i < numbering.own(); ++i) {
        if (!state.locked[i]) set_quadric(state, i);
    }
    return state;
}

Replacement result_of(const SurfaceState& state, const Versions& versions, const Numbering& numbering, std::size_t triangles,
                      const OriginalSurface& original, std::span<const std::array<float, 3>> normals) {
    Replacement result;
    std::vector<std::int64_t> place(numbering.own());
    for (std::uint32_t i = 0; i < place.size(); ++i) {
        place[i] = numbering.points()[i];
        if (!state.mesh.has_point(i) || state.scaled[i] == versions.scaled(place[i])) continue;
        NewPoint point{state.scaled[i], state.points[i], {}, state.faces[i], place[i]};
        if (!normals.empty()) point.normal = normal_near(original, normals, state.scaled[i], state.frame->step());
        result.points.push_back(point);
        place[i] = -static_cast<std::int64_t>(result.points.size());
    }
    for (std::uint32_t t = 0; t < triangles; ++t) {
        if (!state.mesh.has_triangle(t)) continue;
        const auto [a, b, c] = state.mesh.triangle(t);
        result.triangles.push_back({place[a], place[b], place[c]});
    }
    return result;
}

}  // namespace

Replacement simplify_group(const Versions& versions, std::int64_t group, std::span<const TriangleCorners> triangles,
                           std::span<const std::uint8_t> is_locked, const GroupLimits& limits, const CallerLooks& stop_if_asked) {
    const Surface& surface = versions.hierarchy().surface;
    Triangles all(triangles.begin(), triangles.end());
    Numbering numbering;
    numbering.add(all);
    const Triangles beside = versions.beside(group, limits.box);
    numbering.add(beside);
    all.insert(all.end(), beside.begin(), beside.end());
    for (TriangleCorners& t : all) t = {numbering.number(t[0]), numbering.number(t[1]), numbering.number(t[2])};
    const std::size_t own = triangles.size();
    SurfaceState state = state_of(versions, numbering, all, is_locked);
    const std::vector<Vec3> before(state.scaled.begin(), state.scaled.begin() + static_cast<std::ptrdiff_t>(numbering.own()));
    const OriginalSurface original(before, std::span(all).first(own), std::max(versions.frame().step(), limits.max_distance));
    state.distance.original = &original;
    state.distance.max = limits.max_distance;
    state.distance.to_original.assign(own, 0);
    state.distance.tracked = TrackedPieces(own);
    SurfaceBlock block{.box = limits.box, .inside = std::vector<std::uint32_t>(own), .crossing = std::vector<std::uint32_t>(beside.size())};
    std::iota(block.inside.begin(), block.inside.end(), std::uint32_t{0});
    std::iota(block.crossing.begin(), block.crossing.end(), static_cast<std::uint32_t>(own));
    const CollapseLimits quarter{.max_cost = std::numeric_limits<double>::infinity(), .triangles = static_cast<std::int64_t>(own / 4)};
    if (collapse_block(state, block, quarter, stop_if_asked) == 0) return {};
    std::vector<std::array<float, 3>> normals;
    if (!surface.normals.empty()) {
        for (std::size_t i = 0; i < numbering.own(); ++i)
            normals.push_back(surface.normals[static_cast<std::size_t>(numbering.points()[i])]);
    }
    Replacement result = result_of(state, versions, numbering, own, original, normals);
    result.distance = limits.max_distance;
    return result;
}

}  // namespace isoatlas
