// The components of a zone file: cells that share points of the zone.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "methods/search/cell_grid.h"
#include "methods/zones/file_cells.h"

namespace isoatlas {

/// Sorts the cells of a zone by component, and calls visit(cells) for each. In the literature: union-find (Tarjan, 1975).
template <class T, class Visit>
void for_components(const CellGrid<T>& grid, std::span<Filing<T>> cells, const Visit& visit) {
    std::vector<std::size_t> parent(cells.size());
    std::iota(parent.begin(), parent.end(), std::size_t{0});
    const auto find = [&](std::size_t i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    };
    std::vector<std::pair<std::int64_t, std::size_t>> points;  // voxel, cell
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const Index3 place = grid.place(cells[i].cell);
        for (int k = 0; k < grid.corners(); ++k) {
            if ((cells[i].points >> k & 1) != 0)
                points.emplace_back(grid.extent.index(place[0] + (k & 1), place[1] + (k >> 1 & 1), place[2] + (k >> 2)), i);
        }
    }
    std::ranges::sort(points);
    for (std::size_t i = 1; i < points.size(); ++i) {
        if (points[i - 1].first != points[i].first) continue;
        const std::size_t p = find(points[i - 1].second), q = find(points[i].second);
        parent[std::max(p, q)] = std::min(p, q);
    }
    std::vector<std::pair<std::size_t, std::size_t>> order;  // component, cell
    for (std::size_t i = 0; i < cells.size(); ++i) order.emplace_back(find(i), i);
    std::ranges::sort(order);
    const std::vector<Filing<T>> before(cells.begin(), cells.end());
    for (std::size_t i = 0; i < order.size(); ++i) cells[i] = before[order[i].second];
    for (std::size_t begin = 0, end = 0; begin < cells.size(); begin = end) {
        while (end < cells.size() && order[end].first == order[begin].first) ++end;
        visit(cells.subspan(begin, end - begin));
    }
}

}  // namespace isoatlas
