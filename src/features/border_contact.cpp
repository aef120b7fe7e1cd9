#include "features/border_contact.h"

#include <algorithm>
#include <map>

#include "base/paced_fill.h"
#include "base/streamed.h"

namespace isoatlas {
namespace {

/// Calls visit(voxel, sides) for every sample at the border, once; sides as in BorderContact.
template <class Visit>
void for_border(const Extent& extent, const Visit& visit) {
    const Index3 last = extent.size - 1;
    for (std::int64_t z = 0; z <= last[2]; ++z) {
        for (std::int64_t y = 0; y <= last[1]; ++y) {
            unsigned row = 0;
            if (y == 0) row |= 4;
            if (y == last[1]) row |= 8;
            if (extent.rank == 3 && z == 0) row |= 16;
            if (extent.rank == 3 && z == last[2]) row |= 32;
            const std::int64_t step = row != 0 ? 1 : std::max<std::int64_t>(last[0], 1);  // inside a slice only both ends of a row
            for (std::int64_t x = 0; x <= last[0]; x += step) {
                const unsigned sides = row | (x == 0 ? 1U : 0U) | (x == last[0] ? 2U : 0U);
                visit(VoxelId(extent.index(x, y, z)), static_cast<std::uint8_t>(sides));
            }
        }
    }
}

}  // namespace

template <class Id>
void add_border_contacts(const VolumeView& volume, const ObjectTree<Id>& tree, std::vector<ObjectEntry>& entries) {
    constexpr std::int64_t none = -1;
    std::map<EventId, std::vector<std::size_t>> of_event;
    for (std::size_t i = 0; i < entries.size(); ++i) of_event[entries[i].event].push_back(i);
    // Per event: itself or the next one below that has entries.
    IdArray<EventId, std::int64_t> next(filled(tree.size(), none));
    for (const auto& [event, own] : of_event) next[event] = event.number();
    for (const EventId e : streamed_down<EventId>(tree.size(), at_random())) {
        if (next[e] == none && !tree.is_root(e)) next[e] = next[tree.parent(e)];
    }
    std::vector<std::int64_t> samples(entries.size(), 0);
    std::vector<std::uint8_t> sides(entries.size(), 0);
    std::int64_t all = 0;
    visit_samples(volume, [&](auto values) {
        for_border(volume.info->extent, [&](VoxelId voxel, std::uint8_t at) {
            ++all;
            const double height = tree.sign * static_cast<double>(values[voxel.index()]);
            for (std::int64_t e = next[tree.zone(voxel)]; e != none;) {
                const EventId event(e);
                for (const std::size_t i : of_event.at(event)) {
                    if (height < entries[i].best_tau) continue;
                    ++samples[i], sides[i] |= at;
                }
                e = tree.is_root(event) ? none : next[tree.parent(event)];
            }
        });
    });
    for (std::size_t i = 0; i < entries.size(); ++i)
        entries[i].border = {.sides = sides[i], .part = static_cast<double>(samples[i]) / static_cast<double>(all)};
}

#define ISOATLAS_INSTANTIATE(Id) template void add_border_contacts<Id>(const VolumeView&, const ObjectTree<Id>&, std::vector<ObjectEntry>&);
ISOATLAS_INSTANTIATE(std::uint32_t)
ISOATLAS_INSTANTIATE(std::uint64_t)
#undef ISOATLAS_INSTANTIATE

}  // namespace isoatlas
