// Sweeping simplices (section 3.8.3): groups of cells, each with a sweep list by highest sample, whose entries carry a mark, and a min list
// by lowest sample, whose entries point into the sweep list. A query moves along the min list from where the one before stopped, sets or
// clears the marks that it passes, and reports the marked part of the sweep list that reaches the isovalue.
// In the literature: Shen, Johnson, Sweeping simplices: a fast iso-surface extraction algorithm for unstructured grids, 1995. The groups:
// the range of values is halved again and again; a cell belongs to the smallest part that contains its interval.
#pragma once

#include <cmath>
#include <map>

#include "methods/search/cell_grid.h"

namespace isoatlas {

template <class T>
class SweepingSimplices final : public CellSearch {
public:
    explicit SweepingSimplices(const CellGrid<T>& grid) {
        const std::vector<CellInterval<T>> cells = cell_intervals(grid);
        if (cells.empty()) return;
        const auto low = static_cast<double>(std::ranges::min_element(cells, ByLow<T>())->low);
        const auto high = static_cast<double>(std::ranges::max_element(cells, ByHigh<T>())->high);
        std::map<std::pair<int, std::int64_t>, std::size_t> group_of;  // (how often the range was halved, which part)
        for (const CellInterval<T>& c : cells) {
            const auto [at, is_new] = group_of.emplace(part_of(c, low, high), groups_.size());
            if (is_new) groups_.emplace_back();
            groups_[at->second].sweep.push_back({c.low, c.high, c.cell, false});
        }
        for (Group& group : groups_) sort(group);
    }

    std::vector<CellId> active(double tau, CellSearchCost& cost) override {
        std::vector<CellId> found;
        cost = {};
        for (Group& group : groups_) {
            ++cost.nodes;
            if (!(static_cast<double>(group.low) < tau && tau <= static_cast<double>(group.high))) continue;
            move(group, tau, cost);
            const auto first = std::ranges::lower_bound(group.sweep, tau, {}, [](const Swept& s) { return static_cast<double>(s.high); });
            for (auto at = first; at != group.sweep.end(); ++at) {
                ++cost.cells;
                if (at->is_marked) found.push_back(at->cell);
            }
        }
        cost.active = std::ssize(found);
        return found;
    }
    std::int64_t bytes() const override {
        std::int64_t sum = bytes_of(groups_);
        for (const Group& group : groups_) sum += bytes_of(group.sweep) + bytes_of(group.by_low);
        return sum;
    }

private:
    static constexpr int kHalvings = 5;

    struct Swept {
        T low, high;
        CellId cell;
        bool is_marked;  ///< begins below the isovalue of the last query
    };
    struct Group {
        std::vector<Swept> sweep;           ///< by highest sample
        std::vector<std::uint32_t> by_low;  ///< places in `sweep`
        std::size_t marked = 0;             ///< how many of by_low begin below the isovalue of the last query
        T low, high;
    };

    static std::pair<int, std::int64_t> part_of(const CellInterval<T>& c, double low, double high) {
        if (!std::isfinite(high - low)) return {0, 0};
        for (int halvings = kHalvings; halvings > 0; --halvings) {
            const auto parts = static_cast<double>(std::int64_t{1} << halvings);
            const auto part = [&](T value) { return static_cast<std::int64_t>((static_cast<double>(value) - low) / (high - low) * parts); };
            if (part(c.low) == part(c.high)) return {halvings, part(c.low)};
        }
        return {0, 0};
    }

    static void sort(Group& group) {
        std::ranges::sort(group.sweep, [](const Swept& p, const Swept& q) { return p.high != q.high ? p.high < q.high : p.cell < q.cell; });
        group.by_low.resize(group.sweep.size());
        for (std::size_t i = 0; i < group.by_low.size(); ++i) group.by_low[i] = static_cast<std::uint32_t>(i);
        std::ranges::stable_sort(group.by_low, {}, [&group](std::uint32_t i) { return group.sweep[i].low; });
        group.low = group.sweep[group.by_low.front()].low;
        group.high = group.sweep.back().high;
    }

    static void move(Group& group, double tau, CellSearchCost& cost) {
        const auto entry = [&group](std::size_t i) -> Swept& { return group.sweep[group.by_low[i]]; };
        for (; group.marked < group.by_low.size() && static_cast<double>(entry(group.marked).low) < tau; ++group.marked, ++cost.cells)
            entry(group.marked).is_marked = true;
        for (; group.marked > 0 && !(static_cast<double>(entry(group.marked - 1).low) < tau); --group.marked, ++cost.cells)
            entry(group.marked - 1).is_marked = false;
    }

    std::vector<Group> groups_;
};

}  // namespace isoatlas
