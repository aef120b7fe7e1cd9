#include "census/waiting_voxels.h"

namespace isoatlas {

Tops WaitingVoxels::tops_of(std::int64_t voxel) const {
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

std::vector<Tops> WaitingVoxels::slice(std::int64_t z) const {
    const Extent& extent = volume_.info.extent;
    std::vector<Tops> tops(static_cast<std::size_t>(extent.slice()));
    for (std::int64_t i = 0; i < extent.slice(); ++i) tops[static_cast<std::size_t>(i)] = tops_of(z * extent.slice() + i);
    return tops;
}

void WaitingVoxels::add_top(Tops& tops, EventId event) const {
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

void cut_into_pieces(const EventChains& events, std::span<const Tops* const> corners, std::vector<Chain>& pieces) {
    std::array<Chain, 8 * std::tuple_size_v<decltype(Tops::event)>> chains;  // for every cell: nothing is allocated
    auto end = chains.begin();
    for (const Tops* tops : corners) {
        for (const EventId top : tops->list()) {
            const Chain chain{top, tops->end};
            if (std::find(chains.begin(), end, chain) == end) *end++ = chain;
        }
    }
    events.cut_apart(std::span(chains.begin(), end), pieces);
}

}  // namespace isoatlas
