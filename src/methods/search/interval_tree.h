// Interval tree (section 3.8.5): a balanced binary tree over the ends of the cells' intervals; a cell belongs to the highest node whose
// value lies in its interval (lowest, highest]. A node has its cells by ascending lowest (AL) and by descending highest sample (DR); a
// query walks down one path and takes the first cells of one list of every node on it. In the literature: Edelsbrunner, Dynamic data
// structures for orthogonal intersection queries, 1980; Cignoni, Marino, Montani, Puppo, Scopigno, Speeding up isosurface extraction using
// interval trees, 1997.
#pragma once

#include "methods/search/cell_grid.h"

namespace isoatlas {

template <class T>
class IntervalTree {
public:
    explicit IntervalTree(std::vector<CellInterval<T>> cells) {
        std::vector<T> ends;
        for (const CellInterval<T>& c : cells) ends.push_back(c.low), ends.push_back(c.high);
        std::ranges::sort(ends);
        ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
        value_ = std::move(ends);
        if (value_.empty()) return;
        std::vector<std::size_t> node(cells.size());
        first_.assign(value_.size() + 1, 0);
        for (std::size_t i = 0; i < cells.size(); ++i) ++first_[(node[i] = node_of(cells[i])) + 1];
        for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
        std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
        by_low_.resize(cells.size());
        for (std::size_t i = 0; i < cells.size(); ++i) by_low_[next[node[i]]++] = cells[i];
        by_high_ = by_low_;
        for (std::size_t n = 0; n < value_.size(); ++n) {
            std::sort(by_low_.begin() + place(first_[n]), by_low_.begin() + place(first_[n + 1]), ByLow<T>());
            std::sort(by_high_.begin() + place(first_[n]), by_high_.begin() + place(first_[n + 1]),
                      [](const CellInterval<T>& p, const CellInterval<T>& q) { return ByHigh<T>()(q, p); });
        }
    }

    /// Adds the active cells.
    void find(double tau, std::vector<CellId>& found, CellSearchCost& cost) const {
        for (std::size_t begin = 0, end = value_.size(); begin < end;) {
            const std::size_t n = begin + (end - begin) / 2;
            ++cost.nodes;
            const bool is_below = tau <= static_cast<double>(value_[n]);  // then its cells reach tau; else they begin below it
            const std::vector<CellInterval<T>>& list = is_below ? by_low_ : by_high_;
            for (std::size_t i = first_[n]; i < first_[n + 1]; ++i) {
                ++cost.cells;
                if (!(is_below ? list[i].begins_below(tau) : list[i].reaches(tau))) break;
                found.push_back(list[i].cell);
            }
            if (tau == static_cast<double>(value_[n])) return;
            (is_below ? end : begin) = is_below ? n : n + 1;
        }
    }
    [[nodiscard]] std::int64_t bytes() const { return bytes_of(value_) + bytes_of(first_) + bytes_of(by_low_) + bytes_of(by_high_); }

private:
    static std::ptrdiff_t place(std::size_t i) { return static_cast<std::ptrdiff_t>(i); }

    [[nodiscard]] std::size_t node_of(const CellInterval<T>& c) const {
        for (std::size_t begin = 0, end = value_.size();;) {  // ends: its highest sample is the value of a node
            const std::size_t n = begin + (end - begin) / 2;
            if (c.low < value_[n] && value_[n] <= c.high) return n;
            (c.high < value_[n] ? end : begin) = c.high < value_[n] ? n : n + 1;
        }
    }

    std::vector<T> value_;            ///< of the nodes, ascending: the root of a range is its middle
    std::vector<std::size_t> first_;  ///< of the cells of a node
    std::vector<CellInterval<T>> by_low_, by_high_;
};

template <class T>
class IntervalTreeSearch final : public CellSearch {
public:
    explicit IntervalTreeSearch(const CellGrid<T>& grid) : tree_(cell_intervals(grid)) {}

    std::vector<CellId> active(double tau, CellSearchCost& cost) override {
        std::vector<CellId> found;
        cost = {};
        tree_.find(tau, found, cost);
        cost.active = std::ssize(found);
        return found;
    }
    std::int64_t bytes() const override { return tree_.bytes(); }

private:
    IntervalTree<T> tree_;
};

}  // namespace isoatlas
