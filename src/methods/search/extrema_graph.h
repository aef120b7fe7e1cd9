// Extrema graph (section 3.7.2): local minima and maxima, joined by arcs, which are paths of grid edges. Where tau crosses an edge of an
// arc the cells there are active; from such seeds the search goes on from cell to cell across faces with Highs and Lows. Surfaces that
// leave the volume have a seed among the outermost cells. In the literature: Itoh, Koyamada, Automatic isosurface propagation using an
// extrema graph and sorted boundary cell lists, 1995.
//
// Nothing is missed. Let C be a set of active cells, connected in that way, of which none is outermost: its surface is closed. Taking the
// edges that it crosses out of the grid leaves at least two parts. Each holds a local extremum: its highest sample if that is High, for
// then the samples across the removed edges are Low; else its lowest. So some arc crosses C.
#pragma once

#include "methods/search/cell_grid.h"

namespace isoatlas {

template <class T>
class ExtremaGraph final : public CellSearch {
public:
    explicit ExtremaGraph(const CellGrid<T>& grid)
        : grid_(grid), outermost_(cell_intervals(grid, [&grid](const Index3& place) { return grid.is_outermost(place); })) {
        std::ranges::sort(outermost_, ByLow<T>());
        if (grid.count() == 0) return;
        is_found_.assign(static_cast<std::size_t>(grid.count()), false);
        std::int64_t before = -1;
        for (std::int64_t v = 0; v < grid.extent.voxels(); ++v) {
            if (!is_extremum(v)) continue;
            if (before >= 0) add_arc(before, v);
            before = v;
        }
    }

    std::vector<CellId> active(double tau, CellSearchCost& cost) override {
        std::vector<CellId> found;
        cost = {};
        for (const Arc& arc : arcs_) {
            ++cost.nodes;
            if (static_cast<double>(arc.low) < tau && tau <= static_cast<double>(arc.high)) search_arc(arc, tau, found, cost);
        }
        for (const CellInterval<T>& c : outermost_) {
            if (!c.begins_below(tau)) break;
            ++cost.cells;
            if (c.is_active(tau)) seed(c.cell, found);
        }
        for (std::size_t i = 0; i < found.size(); ++i) propagate(found[i], tau, found);
        for (const CellId cell : found) is_found_[cell.index()] = false;
        cost.active = std::ssize(found);
        cost.cells += cost.active;
        return found;
    }
    std::int64_t bytes() const override { return bytes_of(arcs_) + bytes_of(outermost_) + grid_.count() / 8; }

private:
    struct Arc {
        std::int64_t from, to;  ///< samples
        T low, high;            ///< along it
    };

    [[nodiscard]] T value(std::int64_t v) const { return grid_.samples[static_cast<std::size_t>(v)]; }

    /// By (value, number) among its neighbours along the axes.
    [[nodiscard]] bool is_extremum(std::int64_t v) const {
        const Index3 at = grid_.extent.voxel(v);
        bool is_highest = true, is_lowest = true;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (const std::int64_t step : {-1, 1}) {
                Index3 beside = at;
                beside[axis] += step;
                if (beside[axis] < 0 || beside[axis] >= grid_.extent.size[axis]) continue;
                const std::int64_t other = grid_.extent.index(beside);
                const bool is_above = value(other) != value(v) ? value(other) > value(v) : other > v;
                (is_above ? is_highest : is_lowest) = false;
            }
        }
        return is_highest || is_lowest;
    }

    /// Calls visit(sample, next sample) for the edges of an arc: along x, then y, then z.
    template <class Visit>
    void for_edges(std::int64_t from, std::int64_t to, const Visit& visit) const {
        Index3 at = grid_.extent.voxel(from);
        const Index3 end = grid_.extent.voxel(to);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            while (at[axis] != end[axis]) {
                const Index3 before = at;
                at[axis] += at[axis] < end[axis] ? 1 : -1;
                visit(before, at);
            }
        }
    }

    void add_arc(std::int64_t from, std::int64_t to) {
        Arc arc{from, to, std::min(value(from), value(to)), std::max(value(from), value(to))};
        for_edges(from, to, [&](const Index3&, const Index3& at) {
            const T there = value(grid_.extent.index(at));
            arc.low = std::min(arc.low, there), arc.high = std::max(arc.high, there);
        });
        arcs_.push_back(arc);
    }

    void search_arc(const Arc& arc, double tau, std::vector<CellId>& found, CellSearchCost& cost) {
        const auto is_high = [&](const Index3& at) { return static_cast<double>(value(grid_.extent.index(at))) >= tau; };
        for_edges(arc.from, arc.to, [&](const Index3& before, const Index3& at) {
            ++cost.cells;
            if (is_high(before) != is_high(at)) seed(grid_.cell(min(min(before, at), grid_.size - 1)), found);
        });
    }

    void seed(CellId cell, std::vector<CellId>& found) {
        if (is_found_[cell.index()]) return;
        is_found_[cell.index()] = true;
        found.push_back(cell);
    }

    /// Across the faces of an active cell that have Highs and Lows.
    void propagate(CellId cell, double tau, std::vector<CellId>& found) {
        const Index3 place = grid_.place(cell);
        int highs = 0;
        for (int corner = 0; corner < grid_.corners(); ++corner) highs |= static_cast<int>(grid_.is_high(place, corner, tau)) << corner;
        for (std::size_t axis = 0; axis < static_cast<std::size_t>(grid_.extent.rank); ++axis) {
            for (const int side : {0, 1}) {
                int face = 0;
                for (int corner = 0; corner < grid_.corners(); ++corner) face |= static_cast<int>((corner >> axis & 1) == side) << corner;
                if ((highs & face) == 0 || (highs & face) == face) continue;
                Index3 other = place;
                other[axis] += side == 0 ? -1 : 1;
                if (grid_.has(other)) seed(grid_.cell(other), found);
            }
        }
    }

    CellGrid<T> grid_;
    std::vector<Arc> arcs_;
    std::vector<CellInterval<T>> outermost_;
    std::vector<bool> is_found_;  ///< all false between queries
};

}  // namespace isoatlas
