#include "level_of_detail/cluster_level.h"

#include <numeric>

#include "base/parallel.h"
#include "isoatlas/error.h"
#include "level_of_detail/cluster_groups.h"
#include "level_of_detail/simplify_group.h"

namespace isoatlas {

void require_few_triangles(const Surface& surface) {
    constexpr std::size_t kMost = std::size_t{1} << 29;
    if (surface.triangles.size() < kMost) return;
    throw Error(ErrorKind::resource, {.what = "the surface has " + std::to_string(surface.triangles.size()) + " triangles",
                                      .expected = "fewer than 2^29 triangles",
                                      .next = "take its objects one by one"});
}

ClusterLevels::ClusterLevels(ClusterHierarchy& hierarchy, Versions& versions, const Context& context)
    : hierarchy_(hierarchy), versions_(versions), context_(context), current_(hierarchy.clusters.size()) {
    std::iota(current_.begin(), current_.end(), std::int64_t{0});
}

bool ClusterLevels::simplify(std::span<const Group> groups, std::vector<std::int64_t> left, double step,
                             const std::function<void(double)>& told) {
    std::vector<std::vector<std::int64_t>> parts;
    for (const Group& group : groups) parts.push_back(group.clusters);
    for (const std::int64_t cluster : left) parts.push_back({cluster});
    lock_borders(versions_, parts, is_locked_);
    std::vector<BoundingBox> boxes(groups.size());
    std::vector<std::int64_t> numbers(groups.size());
    for (std::size_t i = 0; i < groups.size(); ++i) {
        boxes[i] = groups[i].box;
        numbers[i] = versions_.add_group(groups[i].clusters);
    }
    const std::vector<std::size_t> colours = colours_of(boxes);
    const auto first_new = static_cast<std::int64_t>(hierarchy_.clusters.size());
    for (std::size_t colour = 0, done = 0; done < groups.size(); ++colour) {
        std::vector<std::size_t> of_colour;
        for (std::size_t i = 0; i < groups.size(); ++i) {
            if (colours[i] == colour) of_colour.push_back(i);
        }
        simplify_colour(of_colour, groups, numbers, step, left);
        done += of_colour.size();
        told(static_cast<double>(done) / static_cast<double>(groups.size()));
    }
    current_ = std::move(left);
    const bool has_changed = static_cast<std::int64_t>(hierarchy_.clusters.size()) > first_new;
    for (auto i = first_new; i < static_cast<std::int64_t>(hierarchy_.clusters.size()); ++i) current_.push_back(i);
    return has_changed;
}

/// left: gets the clusters of groups in which nothing can be collapsed.
void ClusterLevels::simplify_colour(std::span<const std::size_t> of_colour, std::span<const Group> groups,
                                    std::span<const std::int64_t> numbers, double step, std::vector<std::int64_t>& left) {
    std::vector<Replacement> replacements(of_colour.size());
    const CallerLooks stop_if_asked(context_);
    for_each_block(context_.threads, static_cast<std::int64_t>(of_colour.size()), [&](std::int64_t k) {
        const std::size_t i = of_colour[static_cast<std::size_t>(k)];
        Triangles triangles;
        for (const std::int64_t cluster : groups[i].clusters) {
            const auto of_cluster = versions_.triangles_of(hierarchy_.clusters[static_cast<std::size_t>(cluster)]);
            triangles.insert(triangles.end(), of_cluster.begin(), of_cluster.end());
        }
        replacements[static_cast<std::size_t>(k)] =
            simplify_group(versions_, numbers[i], triangles, is_locked_, {step, groups[i].box}, stop_if_asked);
    });
    for (std::size_t k = 0; k < of_colour.size(); ++k) {
        const std::size_t i = of_colour[k];
        if (!replacements[k].triangles.empty()) {
            versions_.replace(numbers[i], replacements[k]);
            continue;
        }
        for (const std::int64_t cluster : groups[i].clusters) {
            hierarchy_.clusters[static_cast<std::size_t>(cluster)].replaced_by = -1;
            left.push_back(cluster);
        }
    }
}

}  // namespace isoatlas
