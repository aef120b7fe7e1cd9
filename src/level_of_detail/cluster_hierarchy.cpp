// Level after level: clusters in groups, groups simplified with their borders locked, what comes out in clusters again.
//
// Groups whose boxes are apart are simplified at the same time, colour after colour; each sees all versions that were there before its
// colour.
#include "isoatlas/cluster_hierarchy.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/cancel.h"
#include "base/parallel.h"
#include "geometry/vectors.h"
#include "isoatlas/environment.h"
#include "isoatlas/error.h"
#include "level_of_detail/cluster_groups.h"
#include "level_of_detail/cluster_order.h"
#include "level_of_detail/simplify_group.h"

namespace isoatlas {
namespace {

constexpr std::size_t kMaxOfExact = std::size_t{1} << 29;  // triangles: clusters and corners of a group have numbers of 32 bits

struct Level {
    GroupGrid grid;
    double step;  ///< between a group and what replaces it
};

class HierarchyMaker {
public:
    HierarchyMaker(ClusterHierarchy& hierarchy, const SurfaceFrame& frame, const ClusterOptions& options, const Context& context)
        : hierarchy_(hierarchy),
          versions_(hierarchy, frame, options),
          options_(options),
          context_(context),
          current_(hierarchy.clusters.size()) {
        std::iota(current_.begin(), current_.end(), std::int64_t{0});
        for (const std::int64_t cluster : current_) all_.add(versions_.box(cluster));
        size_ = norm(minus(all_.high, all_.low));
        level_ = {{all_.low, frame.step(), 0}, options.first_distance * frame.step()};
    }

    void run() {
        constexpr std::array kShifts{0.0, 0.5, 0.25, 0.75};
        const auto clusters = static_cast<double>(current_.size());
        for (std::size_t i = 0;; ++i) {
            context_.report("clusters", 0, 1, 1 - static_cast<double>(current_.size()) / clusters);
            level_.grid.edge = std::max(edge_of_group(), level_.grid.edge * std::sqrt(2.0));
            level_.grid.shift = level_.grid.edge * kShifts[i % kShifts.size()];
            const bool has_changed = make_level();
            if (!has_changed && level_.grid.edge > size_ && level_.step > size_ / 8) break;
            level_.step *= 2;
        }
        remove_groups_without_clusters();
    }

private:
    /// Of a cube with the triangles of so many clusters.
    [[nodiscard]] double edge_of_group() const {
        double area = 0;
        std::int64_t triangles = 0;
        for (const std::int64_t i : current_) {
            const Cluster& cluster = hierarchy_.clusters[static_cast<std::size_t>(i)];
            triangles += cluster.triangles;
            for (const TriangleCorners& t : versions_.triangles_of(cluster)) area += versions_.area(t);
        }
        return std::sqrt(static_cast<double>(options_.clusters * options_.triangles) * area / static_cast<double>(triangles));
    }

    /// Has anything been simplified?
    bool make_level() {
        std::vector<std::vector<std::int64_t>> groups = grouped(versions_, current_, level_.grid);
        lock_borders(versions_, groups, is_locked_);
        std::vector<std::int64_t> left;  // alone in their cubes: with others in a larger one
        if (groups.size() > 1) {
            std::erase_if(groups, [&](const std::vector<std::int64_t>& group) {
                if (group.size() == 1) left.push_back(group[0]);
                return group.size() == 1;
            });
        }
        std::vector<BoundingBox> boxes(groups.size());
        std::vector<std::int64_t> numbers(groups.size());
        for (std::size_t i = 0; i < groups.size(); ++i) {
            boxes[i] = box_of(groups[i]);
            numbers[i] = versions_.add_group(groups[i]);
        }
        const std::vector<std::size_t> colours = colours_of(boxes);
        const auto first_new = static_cast<std::int64_t>(hierarchy_.clusters.size());
        for (std::size_t colour = 0, done = 0; done < groups.size(); ++colour) {
            std::vector<std::size_t> of_colour;
            for (std::size_t i = 0; i < groups.size(); ++i) {
                if (colours[i] == colour) of_colour.push_back(i);
            }
            simplify(of_colour, groups, numbers, boxes, left);
            done += of_colour.size();
        }
        current_ = std::move(left);
        const bool has_changed = static_cast<std::int64_t>(hierarchy_.clusters.size()) > first_new;
        for (auto i = first_new; i < static_cast<std::int64_t>(hierarchy_.clusters.size()); ++i) current_.push_back(i);
        return has_changed;
    }

    /// left: gets the clusters of groups in which nothing can be collapsed.
    void simplify(std::span<const std::size_t> of_colour, std::span<const std::vector<std::int64_t>> groups,
                  std::span<const std::int64_t> numbers, std::span<const BoundingBox> boxes, std::vector<std::int64_t>& left) {
        std::vector<Replacement> replacements(of_colour.size());
        const CallerLooks stop_if_asked(context_);
        for_each_block(context_.threads, static_cast<std::int64_t>(of_colour.size()), [&](std::int64_t k) {
            const std::size_t i = of_colour[static_cast<std::size_t>(k)];
            Triangles triangles;
            for (const std::int64_t cluster : groups[i]) {
                const auto of_cluster = versions_.triangles_of(hierarchy_.clusters[static_cast<std::size_t>(cluster)]);
                triangles.insert(triangles.end(), of_cluster.begin(), of_cluster.end());
            }
            replacements[static_cast<std::size_t>(k)] =
                simplify_group(versions_, numbers[i], triangles, is_locked_, {level_.step, boxes[i]}, stop_if_asked);
        });
        for (std::size_t k = 0; k < of_colour.size(); ++k) {
            const std::size_t i = of_colour[k];
            if (!replacements[k].triangles.empty()) {
                versions_.replace(numbers[i], replacements[k]);
                continue;
            }
            for (const std::int64_t cluster : groups[i]) {
                hierarchy_.clusters[static_cast<std::size_t>(cluster)].replaced_by = -1;
                left.push_back(cluster);
            }
        }
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
    const ClusterOptions& options_;
    const Context& context_;
    std::vector<std::int64_t> current_;  ///< clusters that no group replaces so far
    std::vector<std::uint8_t> is_locked_;
    BoundingBox all_;
    double size_ = 0;  ///< of all
    Level level_{};
};

}  // namespace

ClusterHierarchy make_clusters(const Surface& surface, const Geometry& geometry, const Extent& extent, const ClusterOptions& options,
                               const Context& context) {
    const EnvironmentScope scope(context);
    if (!(options.first_distance > 0)) {
        throw Error(ErrorKind::usage, {.what = "the distance of the first level is not positive", .expected = "more than 0"});
    }
    if (options.triangles < 1 || options.clusters < 1) {
        throw Error(ErrorKind::usage, {.what = "the size of clusters or groups is not positive", .expected = "1 or more"});
    }
    if (surface.triangles.size() >= kMaxOfExact) {
        throw Error(ErrorKind::resource, {.what = "the surface has " + std::to_string(surface.triangles.size()) + " triangles",
                                          .expected = "fewer than 2^29 triangles",
                                          .next = "make the clusters of its objects one by one"});
    }
    ClusterHierarchy hierarchy{.surface = surface, .clusters = {}, .groups = {}, .unit = options.unit};
    if (surface.triangles.empty()) return hierarchy;
    const SurfaceFrame frame(surface, geometry, extent, options.unit);
    HierarchyMaker(hierarchy, frame, options, context).run();
    order_by_distance(hierarchy);
    return hierarchy;
}

}  // namespace isoatlas
