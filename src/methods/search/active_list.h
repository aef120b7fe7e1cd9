// Active list (section 3.8.2): the cells sorted by their lowest and by their highest sample, and the largest interval of a cell, Delta. A
// query near the one before adds the cells that begin (end) between both isovalues and purges the list; any other looks at all cells that
// begin within Delta below the isovalue.
// In the literature: Giles, Haimes, Advanced interactive visualization for CFD, 1990.
#pragma once

#include <cmath>
#include <limits>
#include <optional>

#include "methods/search/cell_grid.h"

namespace isoatlas {

template <class T>
class ActiveList final : public CellSearch {
public:
    explicit ActiveList(const CellGrid<T>& grid) : by_low_(cell_intervals(grid)), by_high_(by_low_) {
        std::ranges::sort(by_low_, ByLow<T>());
        std::ranges::sort(by_high_, ByHigh<T>());
        for (const CellInterval<T>& c : by_low_) delta_ = std::max(delta_, static_cast<double>(c.high) - static_cast<double>(c.low));
        delta_ = std::nextafter(delta_, std::numeric_limits<double>::infinity());  // the difference was rounded
    }

    std::vector<CellId> active(double tau, CellSearchCost& cost) override {
        cost = {};
        const std::optional<double> before = std::exchange(tau_, tau);
        if (!before || std::abs(tau - *before) > delta_)
            begin_anew(tau, cost);
        else if (tau > *before)
            add(by_low_, first_from(by_low_, &CellInterval<T>::low, *before), first_from(by_low_, &CellInterval<T>::low, tau), cost);
        else
            add(by_high_, first_from(by_high_, &CellInterval<T>::high, tau), first_from(by_high_, &CellInterval<T>::high, *before), cost);
        cost.cells += std::ssize(list_);
        std::erase_if(list_, [tau](const CellInterval<T>& c) { return !c.is_active(tau); });
        cost.active = std::ssize(list_);
        std::vector<CellId> found;
        for (const CellInterval<T>& c : list_) found.push_back(c.cell);
        return found;
    }
    std::int64_t bytes() const override { return bytes_of(by_low_) + bytes_of(by_high_); }

private:
    using Cells = std::vector<CellInterval<T>>;

    static std::size_t first_from(const Cells& cells, T CellInterval<T>::* end, double value) {
        const auto first =
            std::ranges::lower_bound(cells, value, {}, [end](const CellInterval<T>& c) { return static_cast<double>(c.*end); });
        return static_cast<std::size_t>(first - cells.begin());
    }
    void add(const Cells& cells, std::size_t begin, std::size_t end, CellSearchCost&) {
        list_.insert(list_.end(), cells.begin() + static_cast<std::ptrdiff_t>(begin), cells.begin() + static_cast<std::ptrdiff_t>(end));
    }
    /// A cell that reaches tau begins at most Delta below it, also where the sum is rounded: rounding keeps the order.
    void begin_anew(double tau, CellSearchCost& cost) {
        list_.clear();
        const auto first =
            std::ranges::lower_bound(by_low_, tau, {}, [this](const CellInterval<T>& c) { return static_cast<double>(c.low) + delta_; });
        add(by_low_, static_cast<std::size_t>(first - by_low_.begin()), first_from(by_low_, &CellInterval<T>::low, tau), cost);
    }

    Cells by_low_, by_high_, list_;
    double delta_ = 0;
    std::optional<double> tau_{};
};

}  // namespace isoatlas
