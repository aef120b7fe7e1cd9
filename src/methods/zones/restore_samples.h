// Samples for a surface from the samples of its active cells alone.
//
// Neighbours of different classes span an edge that the surface crosses, and the cells around it are active: so the classes of both are
// known. Hence a sample that is not known is on the same side of tau as each of its neighbours: whatever value of that side it gets, no
// cell becomes active, and the kernel of the product reads no other values.
#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "levelset/threshold.h"
#include "methods/zones/zone_cell.h"

namespace isoatlas {

/// A volume with the samples of these cells, and any value on the right side of tau elsewhere. is_high: the class of all samples when there
/// is no active cell. Cost: O(volume).
template <class T>
[[nodiscard]] Volume restore_samples(const VolumeInfo& info, std::span<const ZoneCell<T>> active, double tau, bool is_high) {
    const Extent& extent = info.extent;
    Volume volume = make_volume(extent, info.type, info.geometry);
    volume.info = info;
    const std::span<T> samples = volume.samples<T>();
    std::vector<bool> known(samples.size());
    const CellGrid<T> grid(extent, samples);
    for (const ZoneCell<T>& cell : active) {
        const Index3 place = grid.place(cell.cell);
        for (int k = 0; k < grid.corners(); ++k) {
            const auto at = static_cast<std::size_t>(extent.index(place[0] + (k & 1), place[1] + (k >> 1 & 1), place[2] + (k >> 2)));
            samples[at] = cell.samples[static_cast<std::size_t>(k)], known[at] = true;
        }
    }
    const auto class_of = [&](std::size_t at) { return static_cast<double>(samples[at]) >= tau; };
    const auto first = static_cast<std::size_t>(std::ranges::find(known, true) - known.begin());
    // Those before the first known one are joined to it by each other.
    const bool starts_high = first < known.size() ? class_of(first) : is_high;
    for (std::size_t at = 0; at < known.size(); ++at) {
        if (known[at]) continue;
        const Index3 place = extent.voxel(static_cast<std::int64_t>(at));
        const std::int64_t back = place[0] > 0 ? 1 : place[1] > 0 ? extent.size[0] : extent.slice();  // to a neighbour
        const bool high = at == 0 ? starts_high : class_of(at - static_cast<std::size_t>(back));
        samples[at] = high ? std::numeric_limits<T>::max() : std::numeric_limits<T>::lowest();
    }
    return volume;
}

}  // namespace isoatlas
