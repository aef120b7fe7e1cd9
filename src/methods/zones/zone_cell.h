// An entry of a list: a cell, the isovalues at which it is reported, and its samples.
#pragma once

#include <array>

#include "methods/disk/interval_tree_format.h"
#include "methods/search/cell_grid.h"

namespace isoatlas {

/// low, high: by zone, of its samples; by path, of the part in which an object of the path crosses it.
template <class T>
struct ZoneCell : CellInterval<T> {
    std::array<T, 8> samples;  ///< at its corners; 2D: the last four are zeros
};

template <class T>
struct EntryForm<ZoneCell<T>> {
    static constexpr std::int64_t kBytes = EntryForm<CellInterval<T>>::kBytes + 8 * sizeof(T);
    static void put(PayloadWriter& to, const ZoneCell<T>& c) { EntryForm<CellInterval<T>>::put(to, c), to.put(c.samples); }
    [[nodiscard]] static ZoneCell<T> get(PayloadReader& from) {
        ZoneCell<T> cell{EntryForm<CellInterval<T>>::get(from), {}};
        cell.samples = from.get<std::array<T, 8>>();
        return cell;
    }
    [[nodiscard]] static std::uint64_t number(const ZoneCell<T>& c) { return c.cell.number(); }
};

}  // namespace isoatlas
