// CellGrid: the cells of a volume, their intervals and their corners.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "field/require_isovalue.h"
#include "isoatlas/cell_search.h"
#include "isoatlas/error.h"

namespace isoatlas {

/// As many cells as ids can tell apart.
inline void require_countable(std::int64_t cells, const std::string& path) {
    if (cells < std::numeric_limits<CellId::Number>::max()) return;
    throw Error(ErrorKind::resource, {.where = path,
                                      .what = "the volume has " + std::to_string(cells) + " cells",
                                      .expected = "fewer than 2^32",
                                      .next = "compare methods on a part of it"});
}

/// The samples are borrowed.
template <class T>
struct CellGrid {
    Extent extent;
    std::span<const T> samples;
    Index3 size;  ///< cells along each axis

    CellGrid(const Extent& of, std::span<const T> values) : extent(of), samples(values), size(of.size) {
        for (int axis = 0; axis < of.rank; ++axis) --size[axis];
    }
    [[nodiscard]] std::int64_t count() const { return size.product(); }
    [[nodiscard]] bool is_2d() const { return extent.rank == 2; }
    [[nodiscard]] int corners() const { return is_2d() ? 4 : 8; }
    [[nodiscard]] Index3 place(CellId cell) const {
        const std::int64_t i = cell.number();
        return {i % size[0], i / size[0] % size[1], i / (size[0] * size[1])};
    }
    [[nodiscard]] CellId cell(const Index3& place) const { return CellId(place[0] + size[0] * (place[1] + size[1] * place[2])); }
    [[nodiscard]] bool has(const Index3& place) const {
        return std::ranges::all_of(std::array{0, 1, 2}, [&](int axis) { return place[axis] >= 0 && place[axis] < size[axis]; });
    }
    /// Is it at the end of the volume?
    [[nodiscard]] bool is_outermost(const Index3& place) const {
        for (int axis = 0; axis < extent.rank; ++axis) {
            if (place[axis] == 0 || place[axis] == size[axis] - 1) return true;
        }
        return false;
    }
    [[nodiscard]] T sample(const Index3& place, int corner) const {
        return samples[static_cast<std::size_t>(
            extent.index(place[0] + (corner & 1), place[1] + (corner >> 1 & 1), place[2] + (corner >> 2)))];
    }
    [[nodiscard]] bool is_high(const Index3& place, int corner, double tau) const {
        return static_cast<double>(sample(place, corner)) >= tau;
    }
    /// Lowest and highest sample.
    [[nodiscard]] std::array<T, 2> interval(const Index3& place) const {
        std::array<T, 2> ends{sample(place, 0), sample(place, 0)};
        for (int corner = 1; corner < corners(); ++corner) {
            const T value = sample(place, corner);
            ends = {std::min(ends[0], value), std::max(ends[1], value)};
        }
        return ends;
    }
};

/// A cell with its lowest and highest sample: a point of the span space.
template <class T>
struct CellInterval {
    T low, high;
    CellId cell;

    [[nodiscard]] bool begins_below(double tau) const { return static_cast<double>(low) < tau; }
    [[nodiscard]] bool reaches(double tau) const { return static_cast<double>(high) >= tau; }
    [[nodiscard]] bool is_active(double tau) const { return begins_below(tau) && reaches(tau); }
};

/// Of all cells that are active at some isovalue, in the order of their numbers. wanted(place): which of them.
template <class T, class Wanted>
[[nodiscard]] std::vector<CellInterval<T>> cell_intervals(const CellGrid<T>& grid, const Wanted& wanted) {
    std::vector<CellInterval<T>> result;
    for (std::int64_t i = 0; i < grid.count(); ++i) {
        const Index3 place = grid.place(CellId(i));
        if (!wanted(place)) continue;
        const std::array<T, 2> ends = grid.interval(place);
        if (ends[0] < ends[1]) result.push_back({ends[0], ends[1], CellId(i)});
    }
    return result;
}
template <class T>
[[nodiscard]] std::vector<CellInterval<T>> cell_intervals(const CellGrid<T>& grid) {
    return cell_intervals(grid, [](const Index3&) { return true; });
}

template <class T>
[[nodiscard]] std::int64_t bytes_of(const std::vector<T>& array) {
    return static_cast<std::int64_t>(array.size() * sizeof(T));
}

/// Orders of cells along one axis of the span space, ties by number.
template <class T>
struct ByLow {
    bool operator()(const CellInterval<T>& p, const CellInterval<T>& q) const { return p.low != q.low ? p.low < q.low : p.cell < q.cell; }
};
template <class T>
struct ByHigh {
    bool operator()(const CellInterval<T>& p, const CellInterval<T>& q) const {
        return p.high != q.high ? p.high < q.high : p.cell < q.cell;
    }
};

}  // namespace isoatlas
