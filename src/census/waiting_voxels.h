// Which zone files a voxel and a cell lie in (section 10.1 of the dissertation): shared by those who count such files and who write them.
//
// The points of the file of a zone are its voxels, and the voxels around its object that wait to be flooded when the zone ends. A voxel
// waits from the zones of its neighbours above it to its own: it lies in the files of chains of events. A cell lies in the files of its
// corners.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "census/event_chains.h"
#include "field/grid.h"
#include "isoatlas/volume.h"
#include "levelset/volume_cells.h"

namespace isoatlas {

/// The zones in which a voxel begins to wait: those of its neighbours above, without those that follow another one.
struct Tops {
    std::array<EventId, 6> event;
    std::size_t count = 0;
    EventId end = EventId::none();  ///< of all its chains

    [[nodiscard]] std::span<const EventId> list() const { return std::span(event).first(count); }
};

/// All are borrowed. analysis: of the volume, with zones.
class WaitingVoxels {
public:
    WaitingVoxels(const Volume& volume, const Analysis& analysis, const EventChains& events)
        : volume_(volume), analysis_(analysis), events_(events) {}

    [[nodiscard]] Tops tops_of(std::int64_t voxel) const;

    /// Calls visit(voxels at the corners, tops of each corner) for the cells whose first corner lies in the slab, in the order of their
    /// numbers, and point(tops) for its voxels.
    template <class Point, class Visit>
    void run(const Slab& slab, const Point& point, const Visit& visit) const {
        const Extent& extent = volume_.info.extent;
        std::vector<Tops> lower, upper = slice(slab.z_begin);
        std::array<const Tops*, 8> at{};
        for (std::int64_t z = slab.z_begin; z < slab.z_end; ++z) {
            lower.swap(upper);
            for (const Tops& tops : lower) point(tops);
            if (z + 1 < extent.size[2]) upper = slice(z + 1);
            for_cells_of_slice(extent, z, [&](std::span<const std::int64_t> corners) {
                for (std::size_t k = 0; k < corners.size(); ++k) {
                    const std::int64_t in_slice = corners[k] - z * extent.slice();
                    at[k] = in_slice < extent.slice() ? &lower[static_cast<std::size_t>(in_slice)]
                                                      : &upper[static_cast<std::size_t>(in_slice - extent.slice())];
                }
                visit(corners, std::span<const Tops* const>(at).first(corners.size()));
            });
        }
    }

private:
    [[nodiscard]] std::vector<Tops> slice(std::int64_t z) const;
    void add_top(Tops& tops, EventId event) const;

    const Volume& volume_;
    const Analysis& analysis_;
    const EventChains& events_;
};

/// Chains with the events in whose files a cell lies, each once. Appended to `pieces`.
void cut_into_pieces(const EventChains& events, std::span<const Tops* const> corners, std::vector<Chain>& pieces);

}  // namespace isoatlas
