#include "census/zone_files.h"

#include <algorithm>
#include <array>
#include <atomic>

#include "base/paced_fill.h"
#include "census/event_chains.h"
#include "census/interval_counts.h"
#include "field/slab_work.h"
#include "levelset/volume_cells.h"

namespace isoatlas {
namespace {

/// The zones in which a voxel begins to wait: those of its neighbours above, without those that follow another one.
struct Tops {
    std::array<EventId, 6> event;
    std::size_t count = 0;
    EventId end = EventId::none();  ///< of all its chains

    [[nodiscard]] std::span<const EventId> list() const { return std::span(event).first(count); }
};

class Counter {
public:
    Counter(const Volume& volume, const Analysis& analysis, std::span<const double> isovalues)
        : volume_(volume),
          analysis_(analysis),
          events_(analysis),
          minima_(events_),
          loaded_(isovalues),
          visited_(isovalues),
          points_(filled(static_cast<std::size_t>(events_.size()) + 1, std::int64_t{0})) {}

    /// Points of the slices [z_begin, z_end), and cells whose first corner lies there.
    void run(const Slab& slab) {
        const Extent& extent = volume_.info.extent;
        std::vector<Tops> lower, upper = slice(slab.z_begin);
        std::vector<Chain> chains, pieces;
        for (std::int64_t z = slab.z_begin; z < slab.z_end; ++z) {
            lower.swap(upper);
            for (const Tops& tops : lower) count_points(tops);
            if (z + 1 < extent.size[2]) upper = slice(z + 1);
            for_cells_of_slice(extent, z, [&](std::span<const std::int64_t> corners) {
                chains.clear(), pieces.clear();
                double highest = volume_.value(corners[0]);
                for (const std::int64_t voxel : corners) {
                    const std::int64_t in_slice = voxel - z * extent.slice();
                    const Tops& tops = in_slice < extent.slice() ? lower[static_cast<std::size_t>(in_slice)]
                                                                 : upper[static_cast<std::size_t>(in_slice - extent.slice())];
                    for (const EventId top : tops.list()) {
                        if (std::ranges::find(chains, Chain{top, tops.end}) == chains.end()) chains.push_back({top, tops.end});
                    }
                    highest = std::max(highest, volume_.value(voxel));
                }
                events_.cut_apart(chains, pieces);
                for (const Chain& piece : pieces) count_cell(piece, highest);
            });
        }
    }

    [[nodiscard]] ZoneFiles result() {
        ZoneFiles files;
        const IdArray<EventId, double> lowest = minima_.take();
        files.points.assign(points_.items().begin(), points_.items().end() - 1);
        for (const EventId e : lowest.ids()) {
            const EventId parent = events_.below(e);
            // The cell that ends the search is visited too.
            visited_.add(std::max(events_.value(parent), lowest[e]), events_.value(e));
            if (parent < events_.end()) files.points[parent.index()] += files.points[e.index()];
        }
        files.loaded = loaded_.counts();
        files.visited = visited_.counts();
        return files;
    }

private:
    [[nodiscard]] std::vector<Tops> slice(std::int64_t z) const {
        const Extent& extent = volume_.info.extent;
        std::vector<Tops> tops(static_cast<std::size_t>(extent.slice()));
        for (std::int64_t i = 0; i < extent.slice(); ++i) tops[static_cast<std::size_t>(i)] = tops_of(z * extent.slice() + i);
        return tops;
    }

    [[nodiscard]] Tops tops_of(std::int64_t voxel) const {
        const Extent& extent = volume_.info.extent;
        const Index3 at = extent.voxel(voxel), step{1, extent.size[0], extent.slice()};
        const double own = volume_.value(voxel);
        Tops tops;
        tops.end = events_.below(analysis_.zone(VoxelId(voxel)));
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (const std::int64_t side : {std::int64_t{-1}, std::int64_t{1}}) {
                const std::int64_t there = at[axis] + side, other = voxel + side * step[axis];
                if (there < 0 || there >= extent.size[axis] || !(volume_.value(other) > own)) continue;
                add_top(tops, analysis_.zone(VoxelId(other)));
            }
        }
        if (tops.count == 0) add_top(tops, analysis_.zone(VoxelId(voxel)));
        return tops;
    }

    void add_top(Tops& tops, EventId event) const {
        for (std::size_t i = 0; i < tops.count;) {
            EventId& other = tops.event[i];
            const EventId meeting = other == event ? event : events_.meeting(other, event);
            if (meeting == event) return;
            if (meeting == other) {
                other = tops.event[--tops.count];
            } else {
                ++i;
            }
        }
        tops.event[tops.count++] = event;
    }

    /// +1 where a chain begins, -1 where it comes into one before or ends: sums over subtrees are points.
    void count_points(const Tops& tops) {
        for (std::size_t i = 0; i < tops.count; ++i) {
            EventId end = tops.end;
            for (std::size_t j = 0; j < i; ++j) end = std::min(end, events_.meeting(tops.event[i], tops.event[j]));
            change(tops.event[i], 1);
            change(end, -1);
        }
    }
    void change(EventId event, std::int64_t by) { std::atomic_ref(points_[event]).fetch_add(by, std::memory_order_relaxed); }

    void count_cell(Chain files, double highest) {
        const double low = events_.value(files.end), high = events_.value(files.top);
        loaded_.add(low, high);
        visited_.add(low, std::min(high, highest));
        minima_.put(files, highest);
    }

    const Volume& volume_;
    const Analysis& analysis_;
    EventChains events_;
    ChainMinima minima_;
    IntervalCounts loaded_, visited_;
    IdArray<EventId, std::int64_t> points_;
};

}  // namespace

ZoneFiles count_zone_files(const Volume& volume, const Analysis& analysis, std::span<const double> isovalues, const Context& context) {
    Counter counter(volume, analysis, isovalues);
    const Extent& extent = volume.info.extent;
    for_each_slab(context, kSearchPhases["zone files"], {extent.size[2], extent.slice()}, [&](const Slab& slab) { counter.run(slab); });
    return counter.result();
}

}  // namespace isoatlas
