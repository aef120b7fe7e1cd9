// Level after level: clusters in groups, groups simplified with their borders locked, what comes out in clusters again.
#include "isoatlas/cluster_hierarchy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "geometry/vectors.h"
#include "isoatlas/environment.h"
#include "isoatlas/error.h"
#include "level_of_detail/cluster_groups.h"
#include "level_of_detail/cluster_level.h"
#include "level_of_detail/cluster_order.h"

namespace isoatlas {
namespace {

struct Level {
    GroupGrid grid;
    double step;  ///< between a group and what replaces it
};

class HierarchyMaker {
public:
    HierarchyMaker(ClusterHierarchy& hierarchy, const SurfaceFrame& frame, const ClusterOptions& options, const Context& context)
        : hierarchy_(hierarchy),
          versions_(hierarchy, frame, options, {}),
          levels_(hierarchy, versions_, context),
          options_(options),
          context_(context) {
        for (const std::int64_t cluster : levels_.current()) all_.add(versions_.box(cluster));
        size_ = norm(minus(all_.high, all_.low));
        level_ = {{all_.low, frame.step(), 0}, options.first_distance * frame.step()};
    }

    void run() {
        constexpr std::array kShifts{0.0, 0.5, 0.25, 0.75};
        all_clusters_ = static_cast<double>(levels_.current().size());
        for (std::size_t i = 0;; ++i) {
            report(0);
            level_.grid.edge = std::max(edge_of_group(), level_.grid.edge * std::sqrt(2.0));
            level_.grid.shift = level_.grid.edge * kShifts[i % kShifts.size()];
            const bool has_changed = make_level();
            if (!has_changed && level_.grid.edge > size_ && level_.step > size_ / 8) break;
            level_.step *= 2;
        }
        remove_groups_without_clusters();
    }

private:
    /// done: of the groups of a level, which leave about a quarter of its clusters.
    void report(double done) const {
        context_.report("clusters", 0, 1, 1 - static_cast<double>(levels_.current().size()) / all_clusters_ * (1 - 0.75 * done));
    }

    /// Of a cube with the triangles of so many clusters.
    [[nodiscard]] double edge_of_group() const {
        double area = 0;
        std::int64_t triangles = 0;
        for (const std::int64_t i : levels_.current()) {
            const Cluster& cluster = hierarchy_.clusters[static_cast<std::size_t>(i)];
            triangles += cluster.triangles;
            for (const TriangleCorners& t : versions_.triangles_of(cluster)) area += versions_.area(t);
        }
        return std::sqrt(static_cast<double>(options_.clusters * options_.triangles) * area / static_cast<double>(triangles));
    }

    /// Has anything been simplified?
    bool make_level() {
        std::vector<std::vector<std::int64_t>> parts = grouped(versions_, levels_.current(), level_.grid);
        std::vector<std::int64_t> left;  // alone in their cubes: with others in a larger one
        if (parts.size() > 1) {
            std::erase_if(parts, [&](const std::vector<std::int64_t>& group) {
                if (group.size() == 1) left.push_back(group[0]);
                return group.size() == 1;
            });
        }
        std::vector<ClusterLevels::Group> groups;
        for (std::vector<std::int64_t>& clusters : parts) {
            const BoundingBox box = box_of(clusters);
            groups.push_back({std::move(clusters), box});
        }
        return levels_.simplify(groups, std::move(left), level_.step, [this](double done) { report(done); });
    }

    /// In which the group is simplified; larger than its points, so that boxes that are apart remain so when positions are rounded.
    [[nodiscard]] BoundingBox box_of(std::span<const std::int64_t> clusters) const {
        BoundingBox box;
        for (const std::int64_t cluster : clusters) box.add(versions_.box(cluster));
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double room = std::min(level_.step, size_ / 64) + 1e-9 * size_;
            box.low[axis] -= room, box.high[axis] += room;
        }
        return box;
    }

    void remove_groups_without_clusters() {
        std::vector<std::int64_t> number(hierarchy_.groups.size(), -1);
        for (const Cluster& cluster : hierarchy_.clusters) {
            if (cluster.made_by >= 0) number[static_cast<std::size_t>(cluster.made_by)] = 0;
        }
        std::int64_t count = 0;
        for (std::size_t i = 0; i < number.size(); ++i) {
            if (number[i] < 0) continue;
            number[i] = count;
            if (static_cast<std::size_t>(count) != i) hierarchy_.groups[static_cast<std::size_t>(count)] = std::move(hierarchy_.groups[i]);
            ++count;
        }
        hierarchy_.groups.resize(static_cast<std::size_t>(count));
        const auto renumber = [&](std::int64_t& group) {
            if (group >= 0) group = number[static_cast<std::size_t>(group)];
        };
        for (ClusterGroup& group : hierarchy_.groups) std::ranges::for_each(group.made_of, renumber);
        for (Cluster& cluster : hierarchy_.clusters) renumber(cluster.made_by), renumber(cluster.replaced_by);
    }

    ClusterHierarchy& hierarchy_;
    Versions versions_;
    ClusterLevels levels_;
    const ClusterOptions& options_;
    const Context& context_;
    BoundingBox all_;
    double size_ = 0;          ///< of all
    double all_clusters_ = 1;  ///< of the exact surface
    Level level_{};
};

}  // namespace

ClusterHierarchy make_clusters(Surface surface, const Geometry& geometry, const Extent& extent, const ClusterOptions& options,
                               const Context& context) {
    const EnvironmentScope scope(context);
    if (!(options.first_distance > 0)) {
        throw Error(ErrorKind::usage, {.what = "the distance of the first level is not positive", .expected = "more than 0"});
    }
    if (options.triangles < 1 || options.clusters < 1) {
        throw Error(ErrorKind::usage, {.what = "the size of clusters or groups is not positive", .expected = "1 or more"});
    }
    require_few_triangles(surface);
    ClusterHierarchy hierarchy{.surface = std::move(surface), .clusters = {}, .groups = {}, .unit = options.unit};
    if (hierarchy.surface.triangles.empty()) return hierarchy;
    const SurfaceFrame frame(hierarchy.surface, geometry, extent, options.unit);
    HierarchyMaker(hierarchy, frame, options, context).run();
    order_by_distance(hierarchy);
    return hierarchy;
}

}  // namespace isoatlas
