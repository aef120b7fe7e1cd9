// Which lists a cell is filed in (phases 2 and 3 of section 10.1): by zone, in those of its corners; by path, in those of the objects that
// cross it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "base/cancel.h"
#include "base/memory_limit.h"
#include "base/parallel.h"
#include "base/streamed_visits.h"
#include "census/waiting_voxels.h"
#include "levelset/threshold.h"
#include "methods/zones/filing_runs.h"
#include "methods/zones/zone_tree.h"

namespace isoatlas {

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

/// By zone: a corner is a point of the zones of its chains.
template <class T>
void file_by_zone(const EventChains& events, const ZoneCell<T>& cell, std::span<const Tops* const> corners,
                  std::vector<Filing<T>>& filings) {
    const auto first = std::ssize(filings);
    for (std::size_t k = 0; k < corners.size(); ++k) {
        for (const EventId top : corners[k]->list()) {
            for (EventId e = top; e != corners[k]->end; e = events.below(e))
                filings.push_back({cell, ZoneNodeId(e.number()), static_cast<std::uint8_t>(1U << k)});
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
template <class T, class Zone>
void file_by_path(const EventChains& events, const IdArray<EventId, ZoneNodeId>& node, const ZoneCell<T>& cell, int corners,
                  const Zone& zone, std::vector<Filing<T>>& filings) {
    const auto first = std::ssize(filings);
    const auto low = static_cast<double>(cell.low);
    for (int k = 0; k < corners; ++k) {
        T high = cell.samples[static_cast<std::size_t>(k)];
        if (!(cell.low < high)) continue;
        for (EventId e = zone(k);;) {
            const ZoneNodeId path = node[e];
            const auto there = std::find_if(filings.begin() + first, filings.end(), [&](const Filing<T>& f) { return f.node == path; });
            if (there != filings.end()) {  // from here on another corner has gone down
                there->cell.high = std::max(there->cell.high, high);
                break;
            }
            const EventId next = events.below(events.head(e));
            const bool ends_above = next != events.end() && events.value(next) > low;
            filings.push_back({{{ends_above ? at_most<T>(events.value(next)) : cell.low, high, cell.cell}, cell.samples}, path, 0xFF});
            if (!ends_above) break;
            high = threshold_for<T>(events.value(next)).min;
            e = next;
        }
    }
}

/// All are borrowed.
struct FiledVolume {
    const Volume& volume;
    const Analysis& analysis;
    const EventChains& events;
    const IdArray<EventId, ZoneNodeId>& node;
    ZoneLayout layout;
};

template <class T>
[[nodiscard]] ZoneCell<T> zone_cell(std::span<const T> samples, std::span<const std::int64_t> corners, CellId id) {
    ZoneCell<T> cell{{0, 0, id}, {}};
    for (std::size_t k = 0; k < corners.size(); ++k) cell.samples[k] = samples[static_cast<std::size_t>(corners[k])];
    const auto [low, high] = std::ranges::minmax(std::span(cell.samples).first(corners.size()));
    cell.low = low, cell.high = high;
    return cell;
}

/// Files cells whose first corner lies in a slab. Calls add(filings) for all, some at a time, and clears them.
template <class T, class Add>
void file_slab(const FiledVolume& of, const Slab& slab, const Add& add) {
    constexpr std::size_t kTogether = 4096;
    const Extent& extent = of.volume.info.extent;
    const std::span<const T> samples = of.volume.samples<T>();
    const CellGrid<T> grid(extent, samples);
    std::vector<Filing<T>> filings;
    StreamedVisits cells({in_order(3).bytes + (is_scratch(of.node.items().data()) ? at_random().bytes : 0)});
    std::int64_t number = slab.z_begin * grid.size[0] * grid.size[1];
    const auto flush = [&](std::size_t enough) {
        if (filings.size() < enough) return;
        add(std::span<const Filing<T>>(filings));
        filings.clear();
    };
    const auto by_path = [&](std::span<const std::int64_t> corners) {
        cells.next();
        const ZoneCell<T> cell = zone_cell(samples, corners, CellId(number++));
        if (!(cell.low < cell.high)) return;
        const auto zone = [&](int k) { return of.analysis.zone(VoxelId(corners[static_cast<std::size_t>(k)])); };
        file_by_path(of.events, of.node, cell, grid.corners(), zone, filings);
        flush(kTogether);
    };
    const auto by_zone = [&](std::span<const std::int64_t> corners, std::span<const Tops* const> tops) {
        cells.next();
        file_by_zone(of.events, zone_cell(samples, corners, CellId(number++)), tops, filings);
        flush(kTogether);
    };
    if (of.layout == ZoneLayout::by_zone) {
        WaitingVoxels(of.volume, of.analysis, of.events).run(slab, [](const Tops&) {}, by_zone);
    } else {
        for (std::int64_t z = slab.z_begin; z < slab.z_end; ++z) for_cells_of_slice(extent, z, by_path);
    }
    flush(1);
}

/// Calls work(slab) for slabs of a volume, several at a time.
template <class Work>
void for_slabs_of_cells(const Extent& extent, const Context& context, const Work& work) {
    constexpr std::int64_t kSlices = 8;
    const CallerLooks look(context);
    for_each_block(context.threads, (extent.size[2] + kSlices - 1) / kSlices, [&](std::int64_t block) {
        look();
        work(Slab{block * kSlices, std::min((block + 1) * kSlices, extent.size[2])});
    });
}

/// Calls add(filings) for the filings of all cells, on several threads.
template <class T, class Add>
void file_cells(const FiledVolume& of, const Context& context, const Add& add) {
    for_slabs_of_cells(of.volume.info.extent, context, [&](const Slab& slab) { file_slab<T>(of, slab, add); });
}

}  // namespace isoatlas
