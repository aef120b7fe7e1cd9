// Kd-tree of the span space (section 3.8.4): cells as points (lowest, highest sample), cut at medians of both coordinates in turn. The tree
// is the order of an array: the root of a range is its middle. A query takes the points that lie left of and above (tau, tau). In the
// literature: Livnat, Shen, Johnson, A near optimal isosurface extraction algorithm using the span space (NOISE), 1996.
#pragma once

#include "methods/search/cell_grid.h"

namespace isoatlas {

template <class T>
class SpanSpaceTree final : public CellSearch {
public:
    explicit SpanSpaceTree(const CellGrid<T>& grid) : cells_(cell_intervals(grid)) {
        std::vector<Range> open{{0, cells_.size(), true, false, false}};
        while (!open.empty()) {
            const Range range = open.back();
            open.pop_back();
            if (range.end - range.begin < 2) continue;
            const auto begin = cells_.begin() + static_cast<std::ptrdiff_t>(range.begin),
                       end = cells_.begin() + static_cast<std::ptrdiff_t>(range.end);
            const auto middle = cells_.begin() + static_cast<std::ptrdiff_t>(range.middle());
            if (range.by_low)
                std::nth_element(begin, middle, end, ByLow<T>());
            else
                std::nth_element(begin, middle, end, ByHigh<T>());
            open.push_back({range.begin, range.middle(), !range.by_low, false, false});
            open.push_back({range.middle() + 1, range.end, !range.by_low, false, false});
        }
    }

    std::vector<CellId> active(double tau, CellSearchCost& cost) override {
        std::vector<CellId> found;
        cost = {};
        std::vector<Range> open{{0, cells_.size(), true, false, false}};
        while (!open.empty()) {
            const Range range = open.back();
            open.pop_back();
            if (range.begin == range.end) continue;
            if (range.all_begin && range.all_reach) {
                for (std::size_t i = range.begin; i < range.end; ++i) found.push_back(cells_[i].cell);
                cost.cells += static_cast<std::int64_t>(range.end - range.begin);
                continue;
            }
            ++cost.nodes, ++cost.cells;
            const CellInterval<T>& root = cells_[range.middle()];
            if (root.is_active(tau)) found.push_back(root.cell);
            Range lower{range.begin, range.middle(), !range.by_low, range.all_begin, range.all_reach};
            Range upper{range.middle() + 1, range.end, !range.by_low, range.all_begin, range.all_reach};
            if (range.by_low) {
                lower.all_begin = lower.all_begin || root.begins_below(tau);
                open.push_back(lower);
                if (root.begins_below(tau)) open.push_back(upper);
            } else {
                upper.all_reach = upper.all_reach || root.reaches(tau);
                open.push_back(upper);
                if (root.reaches(tau)) open.push_back(lower);
            }
        }
        cost.active = std::ssize(found);
        return found;
    }
    std::int64_t bytes() const override { return bytes_of(cells_); }

private:
    /// A subtree.
    struct Range {
        std::size_t begin, end;
        bool by_low;                ///< cut by lowest samples
        bool all_begin, all_reach;  ///< known: all begin below tau; all reach it
        [[nodiscard]] std::size_t middle() const { return begin + (end - begin) / 2; }
    };

    std::vector<CellInterval<T>> cells_;
};

}  // namespace isoatlas
