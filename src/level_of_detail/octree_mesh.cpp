// Notation: a place is that of a cell; cells of level k have the edge `edge` 2^k, in voxels. Pass k simplifies what lies in cells of level
// k, and makes level k + 1 of the result.
#include "isoatlas/octree_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "isoatlas/environment.h"
#include "isoatlas/error.h"
#include "level_of_detail/cluster_level.h"
#include "level_of_detail/collapsible_mesh.h"

namespace isoatlas {
namespace {

using Place = std::array<std::int64_t, 3>;

constexpr double kRounding = 1e-5;   // voxels; less than points are from the planes where they do not lie in them
constexpr std::int64_t kFew = 1000;  // triangles of one cell that need no coarser level
constexpr std::int64_t kMostLevels = 16;

/// Along a Z-order curve, x fastest.
struct ZOrder {
    bool operator()(const Place& a, const Place& b) const {
        const auto is_less_in_top_bit = [](std::int64_t x, std::int64_t y) { return x < y && x < (x ^ y); };
        std::size_t top = 2;
        for (const std::size_t axis : {std::size_t{1}, std::size_t{0}}) {
            if (is_less_in_top_bit(a[top] ^ b[top], a[axis] ^ b[axis])) top = axis;
        }
        return a[top] < b[top];
    }
};

Place coarser(const Place& place, std::int64_t levels) { return {place[0] >> levels, place[1] >> levels, place[2] >> levels}; }

class OctreeMaker {
public:
    OctreeMaker(ClusterHierarchy& hierarchy, const SurfaceFrame& frame, const Extent& extent, const OctreeOptions& options,
                const Context& context)
        : hierarchy_(hierarchy),
          frame_(frame),
          extent_(extent),
          options_(options),
          context_(context),
          versions_(hierarchy, frame, {}, parts_by_cell(hierarchy.surface)),
          levels_(hierarchy, versions_, context) {
        for (const std::int64_t cluster : levels_.current()) places_.push_back(place_of(middle_of(cluster)));
    }

    [[nodiscard]] OctreeMesh run() {
        OctreeMesh mesh{.edge = options_.edge, .levels = {}};
        mesh.levels.push_back(level(0));
        double step = options_.first_distance;
        for (std::int64_t k = 0; k + 1 < kMostLevels; ++k, step *= 2) {
            const std::int64_t triangles = triangles_of(mesh.levels.back());
            const bool is_one_cell = mesh.levels.back().fragments.size() == 1;
            if (is_one_cell && triangles <= kFew) break;
            report(k, 0);
            simplify_cells(k, step);
            OctreeLevel next = level(k + 1);
            if (is_one_cell && 4 * triangles_of(next) > 3 * triangles) break;
            mesh.levels.push_back(std::move(next));
        }
        return mesh;
    }

private:
    /// done: of the cells of level k, which leave about a quarter of the triangles.
    void report(std::int64_t k, double done) const {
        context_.report("octree", 0, 1, 1 - std::pow(0.25, static_cast<double>(k)) * (1 - 0.75 * done));
    }

    static std::int64_t triangles_of(const OctreeLevel& level) {
        std::int64_t triangles = 0;
        for (const OctreeFragment& fragment : level.fragments) triangles += static_cast<std::int64_t>(fragment.triangles.size());
        return triangles;
    }

    /// The cell of level 0; caps just beyond the volume are in its last ones.
    [[nodiscard]] Place place_of(const Vec3& p) const {
        Place place{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::int64_t cells = std::max<std::int64_t>(1, (extent_.size[axis] - 2 + options_.edge) / options_.edge);
            const double at = std::floor((p[axis] + kRounding / 2) / static_cast<double>(options_.edge));
            place[axis] = static_cast<std::int64_t>(std::clamp(at, 0.0, static_cast<double>(cells - 1)));
        }
        return place;
    }
    [[nodiscard]] Vec3 middle_of(std::int64_t cluster) const {
        const BoundingBox& box = versions_.box(cluster);
        return {(box.low[0] + box.high[0]) / 2, (box.low[1] + box.high[1]) / 2, (box.low[2] + box.high[2]) / 2};
    }

    /// Of a cell of a level, and of what lies beyond the volume beside it.
    [[nodiscard]] BoundingBox cell(const Place& place, std::int64_t level) const {
        BoundingBox box;
        const double edge = std::ldexp(static_cast<double>(options_.edge), static_cast<int>(level));
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto at = static_cast<double>(place[axis]);
            box.low[axis] = place[axis] == 0 ? -1 : at * edge - kRounding;
            const bool is_last = (at + 1) * edge >= static_cast<double>(extent_.size[axis] - 1);
            box.high[axis] = (at + 1) * edge + (is_last ? 1 : kRounding);
        }
        return box;
    }

    [[nodiscard]] std::vector<Triangles> parts_by_cell(const Surface& surface) const {
        std::map<Place, Triangles, ZOrder> cells;
        const std::span<const Vec3> points = frame_.scaled();
        for (const TriangleCorners& t : surface.triangles) {
            const Vec3 &a = points[static_cast<std::size_t>(t[0])], &b = points[static_cast<std::size_t>(t[1])],
                       &c = points[static_cast<std::size_t>(t[2])];
            const Place place = place_of({(a[0] + b[0] + c[0]) / 3, (a[1] + b[1] + c[1]) / 3, (a[2] + b[2] + c[2]) / 3});
            const BoundingBox box = cell(place, 0);
            for (const Vec3* p : {&a, &b, &c}) {
                if (box.squared_distance(*p) == 0) continue;
                throw Error(ErrorKind::usage, {.what = "a triangle of the surface crosses a plane between samples",
                                               .expected = "a surface of extract(), not a simplified one"});
            }
            cells[place].push_back(t);
        }
        std::vector<Triangles> parts;
        for (auto& [place, triangles] : cells) parts.push_back(std::move(triangles));
        return parts;
    }

    void simplify_cells(std::int64_t k, double step) {
        std::map<Place, ClusterLevels::Group, ZOrder> cells;
        for (const std::int64_t cluster : levels_.current()) {
            ClusterLevels::Group& group = cells[coarser(places_[static_cast<std::size_t>(cluster)], k)];
            group.clusters.push_back(cluster);
            group.box.add(versions_.box(cluster));
        }
        std::vector<ClusterLevels::Group> groups;
        std::vector<Place> places;
        for (auto& [place, group] : cells) {
            widen(group.box, cell(place, k), step);
            groups.push_back(std::move(group));
            places.push_back({place[0] << k, place[1] << k, place[2] << k});
        }
        const std::size_t first_group = hierarchy_.groups.size();
        (void)levels_.simplify(groups, {}, step, [&](double done) { report(k, done); });
        for (std::size_t i = places_.size(); i < hierarchy_.clusters.size(); ++i)
            places_.push_back(places[static_cast<std::size_t>(hierarchy_.clusters[i].made_by) - first_group]);
    }

    /// By the distance within which points move, but not out of the cell.
    static void widen(BoundingBox& box, const BoundingBox& cell, double step) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            box.low[axis] = std::min(box.low[axis] - 1e-9, std::max(box.low[axis] - step, cell.low[axis]));
            box.high[axis] = std::max(box.high[axis] + 1e-9, std::min(box.high[axis] + step, cell.high[axis]));
        }
    }

    /// The clusters that are current now, in cells of a level.
    [[nodiscard]] OctreeLevel level(std::int64_t number) const {
        std::map<Place, std::vector<std::int64_t>, ZOrder> cells;
        OctreeLevel made;
        for (const std::int64_t i : levels_.current()) {
            cells[coarser(places_[static_cast<std::size_t>(i)], number)].push_back(i);
            const std::int64_t by = hierarchy_.clusters[static_cast<std::size_t>(i)].made_by;
            if (by >= 0) made.distance = std::max(made.distance, hierarchy_.groups[static_cast<std::size_t>(by)].distance);
        }
        std::vector<std::uint32_t> numbers(hierarchy_.surface.points.size(), kNone);
        for (auto& [place, clusters] : cells) {
            std::ranges::sort(clusters);
            made.fragments.push_back(fragment(place, clusters, numbers));
        }
        return made;
    }

    /// numbers: kNone for all points, before and after.
    [[nodiscard]] OctreeFragment fragment(const Place& place, std::span<const std::int64_t> clusters,
                                          std::vector<std::uint32_t>& numbers) const {
        OctreeFragment made{.place = place, .points = {}, .triangles = {}};
        std::vector<std::int64_t> used;
        for (const std::int64_t cluster : clusters) {
            for (const TriangleCorners& t : versions_.triangles_of(hierarchy_.clusters[static_cast<std::size_t>(cluster)])) {
                std::array<std::uint32_t, 3> corners{};
                for (std::size_t i = 0; i < 3; ++i) {
                    std::uint32_t& number = numbers[static_cast<std::size_t>(t[i])];
                    if (number == kNone) {
                        number = static_cast<std::uint32_t>(used.size());
                        used.push_back(t[i]);
                        made.points.push_back(versions_.scaled(t[i]));
                    }
                    corners[i] = number;
                }
                made.triangles.push_back(corners);
            }
        }
        for (const std::int64_t point : used) numbers[static_cast<std::size_t>(point)] = kNone;
        return made;
    }

    ClusterHierarchy& hierarchy_;
    const SurfaceFrame& frame_;
    const Extent& extent_;
    const OctreeOptions& options_;
    const Context& context_;
    Versions versions_;
    ClusterLevels levels_;
    std::vector<Place> places_;  ///< of each cluster, a cell of level 0 in its cell
};

void require(const Surface& surface, const Geometry& geometry, const OctreeOptions& options) {
    if (options.edge < 1 || !(options.first_distance > 0)) {
        throw Error(ErrorKind::usage,
                    {.what = "the edge of a cell or the distance of the first level is not positive", .expected = "more than 0"});
    }
    if (!surface.segments.empty())
        throw Error(ErrorKind::unsupported,
                    {.what = "the contours of a 2D image are curves, and an octree is of triangles", .next = "write .vtp, .obj or .ply"});
    if (std::ranges::any_of(geometry.coordinates, [](const auto& axis) { return !axis.empty(); })) {
        throw Error(ErrorKind::unsupported, {.what = "the samples are unevenly spaced, and the cells of an octree are not",
                                             .next = "resample the volume, or write .glb"});
    }
    require_few_triangles(surface);
}

}  // namespace

OctreeMesh make_octree_mesh(const Surface& surface, const Geometry& geometry, const Extent& extent, const OctreeOptions& options,
                            const Context& context) {
    const EnvironmentScope scope(context);
    require(surface, geometry, options);
    if (surface.triangles.empty()) return {.edge = options.edge, .levels = {}};
    ClusterHierarchy hierarchy{.surface = surface, .clusters = {}, .groups = {}, .unit = DistanceUnit::voxel};
    const SurfaceFrame frame(surface, geometry, extent, DistanceUnit::voxel);
    return OctreeMaker(hierarchy, frame, extent, options, context).run();
}

}  // namespace isoatlas
