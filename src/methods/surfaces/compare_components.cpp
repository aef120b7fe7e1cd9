#include <algorithm>
#include <map>

#include "base/union_find.h"
#include "isoatlas/surface_defects.h"
#include "methods/surfaces/grid_positions.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kNone = -1;

/// The component of every point, from 0 in the order of the first triangle; kNone: in no triangle.
struct Components {
    std::vector<std::int64_t> of_point;
    std::int64_t count = 0;
};

Components components_of(const Surface& surface) {
    UnionFind<std::int64_t> sets(surface.points.size());
    for (const auto& triangle : surface.triangles) {
        for (const std::size_t corner : {1U, 2U}) (void)sets.join(triangle[0], triangle[corner]);
    }
    Components components{std::vector<std::int64_t>(surface.points.size(), kNone)};
    std::vector<std::int64_t> number(surface.points.size(), kNone);
    for (const auto& triangle : surface.triangles) {
        for (const std::int64_t point : triangle) {
            std::int64_t& of_root = number[sets.find(point)];
            if (of_root == kNone) of_root = components.count++;
            components.of_point[point] = of_root;
        }
    }
    return components;
}

struct CrossedEdge {
    std::int64_t edge, component, point;
};

/// Ascending by the edge, each once.
std::vector<CrossedEdge> crossed_edges(const Surface& surface, const Components& components, const GridPositions& positions) {
    std::vector<CrossedEdge> crossed;
    for (std::int64_t point = 0; point < std::ssize(surface.points); ++point) {
        if (components.of_point[point] == kNone) continue;
        if (const auto edge = positions.edge_of(surface.points[point])) crossed.push_back({*edge, components.of_point[point], point});
    }
    std::ranges::sort(crossed, {}, [](const CrossedEdge& at) { return std::pair(at.edge, at.point); });
    return crossed;
}

/// For every number, which other one shares the most edges with it, and how many edges it has in all.
class Partners {
public:
    explicit Partners(std::int64_t count) : best_(count, kNone), most_(count, 0), all_(count, 0) {}
    void add(std::int64_t one, std::int64_t other, std::int64_t shared) {
        all_[one] += shared;
        if (shared > most_[one]) most_[one] = shared, best_[one] = other;
    }
    [[nodiscard]] std::int64_t best(std::int64_t one) const { return best_[one]; }
    /// Does it share all of its edges with its best one?
    [[nodiscard]] bool is_within_best(std::int64_t one) const { return most_[one] == all_[one]; }

private:
    std::vector<std::int64_t> best_, most_, all_;
};

}  // namespace

ComponentDifference compare_components(const Surface& surface, const Surface& reference, const VolumeInfo& info) {
    const GridPositions positions(info);
    const Components own = components_of(surface), right = components_of(reference);
    const std::vector<CrossedEdge> crossed = crossed_edges(surface, own, positions), wanted = crossed_edges(reference, right, positions);
    std::vector<std::int64_t> belongs(surface.points.size(), kNone);  // component of the reference
    std::vector<bool> is_judged(own.count, false);
    std::map<std::array<std::int64_t, 2>, std::int64_t> shared;
    for (auto at = wanted.begin(); const CrossedEdge& edge : crossed) {
        is_judged[edge.component] = true;
        while (at != wanted.end() && at->edge < edge.edge) ++at;
        if (at == wanted.end() || at->edge != edge.edge) continue;
        belongs[edge.point] = at->component;
        ++shared[{edge.component, at->component}];
    }
    Partners of_own(own.count), of_right(right.count);
    for (const auto& [pair, edges] : shared) of_own.add(pair[0], pair[1], edges), of_right.add(pair[1], pair[0], edges);
    const auto are_partners = [&](std::int64_t mine, std::int64_t theirs) {
        return theirs != kNone && of_own.best(mine) == theirs && of_right.best(theirs) == mine;
    };
    ComponentDifference difference{.components = own.count};
    for (std::int64_t mine = 0; mine < own.count; ++mine) {
        const std::int64_t best = of_own.best(mine);
        const bool is_equal = are_partners(mine, best) && of_own.is_within_best(mine) && of_right.is_within_best(best);
        difference.wrong += is_judged[mine] && !is_equal;
    }
    for (std::int64_t triangle = 0; triangle < std::ssize(surface.triangles); ++triangle) {
        const auto& corners = surface.triangles[triangle];
        const std::int64_t mine = own.of_point[corners[0]];
        const bool has_partner = !is_judged[mine] || are_partners(mine, of_own.best(mine));
        const bool is_elsewhere = std::ranges::any_of(
            corners, [&](std::int64_t point) { return belongs[point] != kNone && !are_partners(mine, belongs[point]); });
        if (!has_partner || is_elsewhere) difference.misplaced_triangles.push_back(triangle);
    }
    return difference;
}

}  // namespace isoatlas
