#include "level_of_detail/cluster_groups.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace isoatlas {

std::vector<std::vector<std::int64_t>> grouped(const Versions& versions, std::span<const std::int64_t> clusters, const GroupGrid& grid) {
    struct Placed {
        std::array<std::int64_t, 3> cube;
        std::int64_t cluster;
    };
    std::vector<Placed> placed;
    for (const std::int64_t cluster : clusters) {
        const BoundingBox& box = versions.box(cluster);
        Placed place{{}, cluster};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double middle = (box.low[axis] + box.high[axis]) / 2 - grid.low[axis] + grid.shift;
            place.cube[axis] = static_cast<std::int64_t>(std::floor(middle / grid.edge));
        }
        placed.push_back(place);
    }
    std::ranges::sort(placed, [](const Placed& a, const Placed& b) { return std::tie(a.cube, a.cluster) < std::tie(b.cube, b.cluster); });
    std::vector<std::vector<std::int64_t>> groups;
    for (std::size_t i = 0; i < placed.size(); ++i) {
        if (i == 0 || placed[i].cube != placed[i - 1].cube) groups.emplace_back();
        groups.back().push_back(placed[i].cluster);
    }
    return groups;
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

void lock_borders(const Versions& versions, std::span<const std::vector<std::int64_t>> groups, std::vector<std::uint8_t>& is_locked) {
    constexpr std::uint32_t kNoGroup = kNone;
    const std::size_t points = versions.hierarchy().surface.points.size();
    std::vector<std::uint32_t> group_of(points, kNoGroup);
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
