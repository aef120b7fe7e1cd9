#include "level_of_detail/cluster_groups.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace isoatlas {

namespace {

using Cube = std::array<std::int64_t, 3>;
using Groups = std::map<Cube, std::vector<std::int64_t>>;

/// The largest group in the cubes around; the first of those. Null: there is none.
std::vector<std::int64_t>* largest_beside(Groups& groups, const Cube& cube) {
    std::vector<std::int64_t>* largest = nullptr;
    for (std::int64_t i = 0; i < 27; ++i) {
        const auto found = groups.find({cube[0] + i / 9 - 1, cube[1] + i / 3 % 3 - 1, cube[2] + i % 3 - 1});
        if (found == groups.end() || found->first == cube || found->second.empty()) continue;
        if (largest == nullptr || found->second.size() > largest->size()) largest = &found->second;
    }
    return largest;
}

}  // namespace

std::vector<std::vector<std::int64_t>> grouped(const Versions& versions, std::span<const std::int64_t> clusters, const GroupGrid& grid) {
    Groups groups;
    for (const std::int64_t cluster : clusters) {
        const BoundingBox& box = versions.box(cluster);
        Cube cube{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double middle = (box.low[axis] + box.high[axis]) / 2 - grid.low[axis] + grid.shift;
            cube[axis] = static_cast<std::int64_t>(std::floor(middle / grid.edge));
        }
        groups[cube].push_back(cluster);
    }
    for (auto& [cube, alone] : groups) {
        if (alone.size() != 1) continue;
        std::vector<std::int64_t>* const largest = largest_beside(groups, cube);
        if (largest == nullptr) continue;
        largest->push_back(alone[0]);
        alone.clear();
    }
    std::vector<std::vector<std::int64_t>> filled;
    for (auto& [cube, group] : groups) {
        if (!group.empty()) filled.push_back(std::move(group));
    }
    return filled;
}

std::vector<std::size_t> colours_of(std::span<const BoundingBox> boxes) {
    BoundingBox all;
    double edges = 0;
    for (const BoundingBox& box : boxes) {
        all.add(box);
        for (std::size_t axis = 0; axis < 3; ++axis) edges = std::max(edges, box.high[axis] - box.low[axis]);
    }
    std::vector<std::size_t> colours(boxes.size());
    if (boxes.empty()) return colours;
    TriangleGrid places;
    places.clear(all, std::max(edges, 1e-300));
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        std::vector<std::uint8_t> is_taken;
        (void)places.for_each(boxes[i], [&](std::uint32_t other) {
            if (!boxes[other].meets(boxes[i])) return true;
            if (colours[other] >= is_taken.size()) is_taken.resize(colours[other] + 1, 0);
            is_taken[colours[other]] = 1;
            return true;
        });
        colours[i] = static_cast<std::size_t>(std::ranges::find(is_taken, std::uint8_t{0}) - is_taken.begin());
        places.add(static_cast<std::uint32_t>(i), boxes[i]);
    }
    return colours;
}

void lock_borders(const Versions& versions, std::span<const std::vector<std::int64_t>> groups, Array<std::uint8_t>& is_locked) {
    constexpr std::uint32_t kNoGroup = kNone;
    const std::size_t points = versions.hierarchy().surface.points.size();
    Array<std::uint32_t> group_of(points, kNoGroup);
    is_locked.assign(points, 0);
    for (std::uint32_t group = 0; group < groups.size(); ++group) {
        for (const std::int64_t cluster : groups[group]) {
            for (const TriangleCorners& t : versions.triangles_of(versions.hierarchy().clusters[static_cast<std::size_t>(cluster)])) {
                for (const std::int64_t point : t) {
                    std::uint32_t& first = group_of[static_cast<std::size_t>(point)];
                    if (first == kNoGroup) first = group;
                    if (first != group) is_locked[static_cast<std::size_t>(point)] = 1;
                }
            }
        }
    }
}

}  // namespace isoatlas
