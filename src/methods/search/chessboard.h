// Interval tree over the black cells of a chessboard (section 3.8.5): those whose three numbers are all even or all odd, a quarter of all
// (2D: a half). Each inner edge of the grid has one black cell, so an active white cell lies beside an active black one, across an edge
// that tau crosses. At the end of the volume an edge may have none; the outermost cells are in the tree whatever their colour. In the
// literature: Cignoni, Marino, Montani, Puppo, Scopigno, Speeding up isosurface extraction using interval trees, 1997.
#pragma once

#include "field/cell.h"
#include "methods/search/interval_tree.h"

namespace isoatlas {

template <class T>
class ChessboardIntervalTree final : public CellSearch {
public:
    explicit ChessboardIntervalTree(const CellGrid<T>& grid)
        : grid_(grid),
          tree_(cell_intervals(grid, [&grid](const Index3& place) { return is_black(grid, place) || grid.is_outermost(place); })),
          is_found_(static_cast<std::size_t>(grid.count()), false) {}

    std::vector<CellId> active(double tau, CellSearchCost& cost) override {
        std::vector<CellId> found;
        cost = {};
        tree_.find(tau, found, cost);
        for (const CellId cell : found) is_found_[cell.index()] = true;
        const std::size_t of_tree = found.size();
        for (std::size_t i = 0; i < of_tree; ++i) {
            const Index3 place = grid_.place(found[i]);
            if (is_black(grid_, place)) add_around(place, tau, found, cost);
        }
        for (const CellId cell : found) is_found_[cell.index()] = false;
        cost.active = std::ssize(found);
        return found;
    }
    std::int64_t bytes() const override { return tree_.bytes() + grid_.count() / 8; }

private:
    static bool is_black(const CellGrid<T>& grid, const Index3& place) {
        return ((place[0] ^ place[1]) & 1) == 0 && (grid.is_2d() || ((place[0] ^ place[2]) & 1) == 0);
    }

    /// The cells around the edges of a black cell that tau crosses.
    void add_around(const Index3& place, double tau, std::vector<CellId>& found, CellSearchCost& cost) {
        for (std::size_t edge = 0; edge < kEdgeCorners.size(); ++edge) {
            const auto [from, to] = kEdgeCorners[edge];
            if (to >= grid_.corners() || grid_.is_high(place, from, tau) == grid_.is_high(place, to, tau)) continue;
            const auto along = edge / 4, first = static_cast<std::size_t>(along == 0 ? 1 : 0),
                       second = static_cast<std::size_t>(along == 2 ? 1 : 2);
            const auto beside = [start = from](std::size_t axis) { return std::int64_t{(start >> axis & 1) != 0 ? 1 : -1}; };
            for (int k = 1; k < 4; ++k) {
                Index3 other = place;
                if ((k & 1) != 0) other[first] += beside(first);
                if ((k & 2) != 0) other[second] += beside(second);
                if (!grid_.has(other)) continue;
                ++cost.cells;
                const CellId cell = grid_.cell(other);
                if (is_found_[cell.index()]) continue;
                is_found_[cell.index()] = true;
                found.push_back(cell);
            }
        }
    }

    CellGrid<T> grid_;
    IntervalTree<T> tree_;
    std::vector<bool> is_found_;  ///< all false between queries
};

}  // namespace isoatlas
