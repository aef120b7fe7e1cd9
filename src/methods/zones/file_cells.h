// Which lists a cell is filed in (phases 2 and 3 of section 10.1): by zone, in those of its corners; by path, in those of the objects that
// cross it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "base/cancel.h"
#include "census/waiting_voxels.h"
#include "isoatlas/error.h"
#include "levelset/threshold.h"
#include "methods/search/cell_grid.h"
#include "methods/zones/zone_tree.h"

namespace isoatlas {

/// A cell in the list of a node.
template <class T>
struct Filing {
    ZoneNodeId node;
    CellId cell;
    T low, high;          ///< as of ZoneCell
    std::uint8_t points;  ///< by zone: which of its corners are points of the zone, a bit each
};

/// The largest T that is at most a finite value, one of T's range.
template <class T>
[[nodiscard]] T at_most(double value) {
    if constexpr (std::is_integral_v<T>) {
        return static_cast<T>(std::floor(value));
    } else {
        const T near = static_cast<T>(value);
        return static_cast<double>(near) > value ? std::nextafter(near, std::numeric_limits<T>::lowest()) : near;
    }
}

/// A cell whose samples differ.
template <class T>
struct MixedCell {
    CellId cell;
    T low, high;
};

/// By zone: a corner is a point of the zones of its chains.
template <class T>
void file_by_zone(const EventChains& events, const MixedCell<T>& cell, std::span<const Tops* const> corners,
                  std::vector<Filing<T>>& filings) {
    const auto first = std::ssize(filings);
    for (std::size_t k = 0; k < corners.size(); ++k) {
        for (const EventId top : corners[k]->list()) {
            for (EventId e = top; e != corners[k]->end; e = events.below(e))
                filings.push_back({ZoneNodeId(e.number()), cell.cell, cell.low, cell.high, static_cast<std::uint8_t>(1U << k)});
        }
    }
    const auto own = std::span(filings).subspan(static_cast<std::size_t>(first));
    std::ranges::sort(own, {}, &Filing<T>::node);
    auto last = filings.begin() + first;
    for (const Filing<T>& filing : own) {
        if (last != filings.begin() + first && (last - 1)->node == filing.node)
            (last - 1)->points |= filing.points;
        else
            *last++ = filing;
    }
    filings.erase(last, filings.end());
}

/// By path: the object of a High corner crosses the cell wherever the cell has Lows. From the zone of each corner towards the root, path
/// by path, as long as that lies above the lowest sample. Ends of zones that are no samples are rounded to samples outwards: there the
/// entry is reported twice, or the path is not active.
/// node: per event. zone(k): that of corner k.
template <class T, class Zone, class Sample>
void file_by_path(const EventChains& events, std::span<const ZoneNodeId> node, const MixedCell<T>& cell, int corners, const Zone& zone,
                  const Sample& sample, std::vector<Filing<T>>& filings) {
    const auto first = std::ssize(filings);
    const auto low = static_cast<double>(cell.low);
    for (int k = 0; k < corners; ++k) {
        T high = sample(k);
        if (!(cell.low < high)) continue;
        for (EventId e = zone(k);;) {
            const ZoneNodeId path = node[e.index()];
            const auto there = std::find_if(filings.begin() + first, filings.end(), [&](const Filing<T>& f) { return f.node == path; });
            if (there != filings.end()) {  // from here on another corner has gone down
                there->high = std::max(there->high, high);
                break;
            }
            const EventId next = events.below(events.head(e));
            const bool ends_above = next != events.end() && events.value(next) > low;
            filings.push_back({path, cell.cell, ends_above ? at_most<T>(events.value(next)) : cell.low, high, 0xFF});
            if (!ends_above) break;
            high = threshold_for<T>(events.value(next)).min;
            e = next;
        }
    }
}

inline void refuse_if_too_many(std::int64_t entries, std::int64_t max, const std::string& path) {
    if (entries <= max) return;
    throw Error(ErrorKind::resource, {.where = path,
                                      .what = "the lists would have " + std::to_string(entries) + " entries or more",
                                      .expected = "at most " + std::to_string(max),
                                      .next = "write them by path, or those of a smaller volume"});
}

/// Of all cells. node: per event. Throws Error{resource} for more than `max`.
template <class T>
[[nodiscard]] std::vector<Filing<T>> file_cells(const Volume& volume, const Analysis& analysis, const EventChains& events,
                                                std::span<const ZoneNodeId> node, ZoneLayout layout, std::int64_t max,
                                                const Context& context) {
    const CellGrid<T> grid(volume.info.extent, volume.samples<T>());
    std::vector<Filing<T>> filings;
    const WaitingVoxels voxels(volume, analysis, events);
    std::int64_t number = 0;
    const auto mixed = [&](CellId id) {
        const std::array<T, 2> ends = grid.interval(grid.place(id));
        return MixedCell<T>{id, ends[0], ends[1]};
    };
    for (std::int64_t z = 0; z < volume.info.extent.size[2]; ++z) {
        stop_if_cancelled(context);
        const auto by_path = [&](std::span<const std::int64_t> corners) {
            const MixedCell<T> cell = mixed(CellId(number++));
            if (cell.low < cell.high)
                file_by_path(
                    events, node, cell, grid.corners(), [&](int k) { return analysis.zone(VoxelId(corners[static_cast<std::size_t>(k)])); },
                    [&](int k) { return grid.samples[static_cast<std::size_t>(corners[static_cast<std::size_t>(k)])]; }, filings);
        };
        const auto by_zone = [&](std::span<const std::int64_t>, std::span<const Tops* const> tops) {
            file_by_zone(events, mixed(CellId(number++)), tops, filings);
        };
        if (layout == ZoneLayout::by_path)
            for_cells_of_slice(volume.info.extent, z, by_path);
        else
            voxels.run({z, z + 1}, [](const Tops&) {}, by_zone);
        refuse_if_too_many(std::ssize(filings), max, volume.info.path);
    }
    return filings;
}

}  // namespace isoatlas
