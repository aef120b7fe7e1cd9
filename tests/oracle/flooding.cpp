#include "oracle/flooding.h"

#include <queue>
#include <utility>

namespace oracle {
namespace {

std::vector<std::vector<Index>> neighbours_of(const Elements& elements) {
    std::vector<std::vector<Index>> neighbours(elements.all.size());
    const Grid& grid = elements.grid;
    for (Index v = 0; v < grid.voxels(); ++v) {
        for (int d = 0; d < grid.directions(); ++d) {
            if (grid.neighbour(v, d) >= 0) neighbours[v].push_back(grid.neighbour(v, d));
        }
    }
    for (Index e = grid.voxels(); e < elements.count(); ++e) {
        const Element& element = elements.all[e];
        if (element.type == Type::body) {  // edges of the graph of the Highs; a body point is critical, so nothing floods into it
            for (const Index corner : element.joins_highs ? element.tunnel : std::vector<Index>{element.ring[0]}) {
                if (elements.rank_of[corner] > elements.rank_of[e]) neighbours[e].push_back(corner);
            }
            continue;
        }
        for (const Index corner : element.corner) {
            neighbours[e].push_back(corner);
            neighbours[corner].push_back(e);
        }
    }
    return neighbours;
}

}  // namespace

Flooding flood(const Elements& elements, std::span<const CriticalElement> critical) {
    const std::vector<std::vector<Index>> neighbours = neighbours_of(elements);
    Flooding result;
    result.parent.assign(critical.size(), -1);
    std::vector<Index>& label = result.label;  // tentative until the element has left the heap
    label.assign(elements.all.size(), -1);
    std::vector<bool> is_final(elements.all.size(), false);
    std::vector<Index> node_of(elements.all.size(), -1);
    std::priority_queue<std::pair<Index, Index>> heap;  // (rank, element)
    for (std::size_t p = 0; p < critical.size(); ++p) {
        const Index e = critical[p].element;
        node_of[e] = label[e] = static_cast<Index>(p);
        heap.push({elements.rank_of[e], e});
    }
    const auto root = [&result](Index node) {
        while (result.parent[node] >= 0) node = result.parent[node];
        return node;
    };
    while (!heap.empty()) {
        const Index e = heap.top().second;
        heap.pop();
        const Index p = node_of[e];
        label[e] = p >= 0 ? p : root(label[e]);
        is_final[e] = true;
        for (const Index q : neighbours[e]) {
            if (label[q] < 0) {
                label[q] = label[e];
                heap.push({elements.rank_of[q], q});
            } else if (p >= 0 && is_final[q] && root(label[q]) != p) {
                result.parent[root(label[q])] = p;  // a zone above ends here
            }
        }
    }
    return result;
}

}  // namespace oracle
