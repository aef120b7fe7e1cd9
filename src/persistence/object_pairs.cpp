// pair_objects: the elder rule on the criticality tree.
#include "isoatlas/persistence.h"

#include <algorithm>
#include <limits>

namespace isoatlas {

std::vector<ObjectPair> pair_objects(const Analysis& analysis) {
    std::vector<ObjectPair> pairs;
    std::vector<EventId> oldest(static_cast<std::size_t>(analysis.event_count()));  // maximum of the object below each event
    for (const EventId id : ids<EventId>(analysis.event_count())) {
        const Event event = analysis.event(id);
        EventId& eldest = oldest[id.index()];
        eldest = id;
        // Events descend, so the highest maximum is the one with the smallest id.
        for (const EventId child : event.children) eldest = std::min(eldest, oldest[child.index()]);
        for (const EventId child : event.children) {
            const EventId maximum = oldest[child.index()];
            if (maximum != eldest) pairs.push_back({analysis.event(maximum).value, event.value, maximum, id});
        }
    }
    if (!oldest.empty()) {
        const EventId first = oldest.back();
        pairs.push_back({analysis.event(first).value, -std::numeric_limits<double>::infinity(), first, EventId::none()});
    }
    std::ranges::sort(pairs, {}, &ObjectPair::maximum);
    return pairs;
}

}  // namespace isoatlas
