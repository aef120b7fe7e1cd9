// Brute force: every cell is looked at. Marching Cubes as it was published (section 3.2).
#pragma once

#include "methods/search/cell_grid.h"

namespace isoatlas {

template <class T>
class BruteForce final : public CellSearch {
public:
    explicit BruteForce(const CellGrid<T>& grid) : grid_(grid) {}

    std::vector<CellId> active(double tau, CellSearchCost& cost) override {
        std::vector<CellId> found;
        for (std::int64_t i = 0; i < grid_.count(); ++i) {
            const std::array<T, 2> ends = grid_.interval(grid_.place(CellId(i)));
            if (CellInterval<T>{ends[0], ends[1], CellId(i)}.is_active(tau)) found.emplace_back(i);
        }
        cost = {std::ssize(found), grid_.count(), 0};
        return found;
    }
    std::int64_t bytes() const override { return 0; }

private:
    CellGrid<T> grid_;
};

}  // namespace isoatlas
