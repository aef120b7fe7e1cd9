#include "analysis/event_alone.h"

#include <limits>

#include "field/order.h"
#include "isoatlas/error.h"

namespace isoatlas {

Event event_alone(const Analysis::Data& data, EventId id) {
    return data.visit([&](const auto& held) {
        const auto& arrays = held.arrays;
        const auto& tree = arrays.tree;
        const auto& measures = arrays.measures;
        if (!(id >= EventId(0) && id < EventId(tree.size())))
            throw Error(ErrorKind::usage, {.what = "no such event: the id is out of range"});
        const bool is_3d = data.extent.rank == 3, root = tree.is_root(id), has_zones = !arrays.voxels.empty();
        Event event{};
        event.id = id;
        event.value = arrays.value[tree.top[id]];
        event.position = element_position(ElementCode{arrays.code[tree.top[id]]}, data.extent);
        event.kind = measures.kind[id];
        event.parent = root ? EventId::none() : EventId(tree.parent[id]);
        event.lows_out = static_cast<std::int64_t>(measures.lows_out[id]);
        event.delta_chi = measures.delta_chi[id];
        event.zone = {root ? -std::numeric_limits<double>::infinity() : arrays.value[tree.top[tree.parent[id]]], event.value,
                      has_zones ? static_cast<std::int64_t>(arrays.voxels[id]) : 0};
        event.chi = measures.chi[id];
        event.contours = static_cast<std::int64_t>(measures.contours[id]);
        event.b2 = is_3d ? event.contours - 1 : 0;
        event.b1 = 1 + event.b2 - event.chi;
        return event;
    });
}

}  // namespace isoatlas
