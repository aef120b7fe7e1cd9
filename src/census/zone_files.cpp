#include "census/zone_files.h"

#include <algorithm>
#include <atomic>

#include "base/paced_fill.h"
#include "census/event_chains.h"
#include "census/interval_counts.h"
#include "census/waiting_voxels.h"
#include "field/slab_work.h"

namespace isoatlas {
namespace {

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
        std::vector<Chain> pieces;
        WaitingVoxels(volume_, analysis_, events_)
            .run(
                slab, [&](const Tops& tops) { count_points(tops); },
                [&](std::span<const std::int64_t> corners, std::span<const Tops* const> tops) {
                    double highest = volume_.value(corners[0]);
                    for (const std::int64_t voxel : corners) highest = std::max(highest, volume_.value(voxel));
                    pieces.clear();
                    cut_into_pieces(events_, tops, pieces);
                    for (const Chain& piece : pieces) count_cell(piece, highest);
                });
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
