// Chains of the criticality tree: an event and some of its ancestors. Finds the event at which two chains meet.
//
// The tree is cut into heavy paths (every event continues the path of its child with most events above it), so the lowest common ancestor
// takes O(log events), and a chain is O(log events) ranges of positions.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/id_array.h"
#include "isoatlas/analysis.h"

namespace isoatlas {

/// The events from `top` towards the root, without `end`, which follows the last one (one after the root: up to it).
struct Chain {
    EventId top, end;
    bool operator==(const Chain&) const = default;
};

class EventChains {
public:
    /// Cost: O(events) time, 40 bytes an event.
    explicit EventChains(const Analysis& analysis);

    [[nodiscard]] std::int64_t size() const { return static_cast<std::int64_t>(head_.size()); }
    /// One after the root.
    [[nodiscard]] EventId end() const { return EventId(head_.size()); }
    /// The parent; end() for the root.
    [[nodiscard]] EventId below(EventId event) const { return below_[event]; }
    /// The critical value; -infinity for end().
    [[nodiscard]] double value(EventId event) const { return value_[event]; }
    /// The lowest common ancestor: the highest event that both become part of.
    [[nodiscard]] EventId meeting(EventId a, EventId b) const;
    /// The event of its heavy path that is nearest to the root: the name of the path.
    [[nodiscard]] EventId head(EventId event) const { return head_[event]; }
    /// Position of an event on the heavy paths.
    [[nodiscard]] std::int64_t position(EventId event) const { return position_[event]; }

    /// Calls visit(first, last) for ranges of positions, both included, that make up the chain.
    template <class Visit>
    void for_ranges(Chain chain, const Visit& visit) const {
        EventId event = chain.top;
        while (event != chain.end && event != end()) {
            const EventId head = head_[event];
            if (chain.end != end() && head_[chain.end] == head) {
                visit(position(chain.end) + 1, position(event));
                return;
            }
            visit(position(head), position(event));
            event = below(head);
        }
    }

    /// Chains with the same events, each in one of them, are appended to `pieces`. `chains` may overlap.
    void cut_apart(std::span<const Chain> chains, std::vector<Chain>& pieces) const;

private:
    IdArray<EventId, EventId> below_, head_;  ///< head: the event of its path that is nearest to the root
    IdArray<EventId, std::int64_t> position_;
    IdArray<EventId, double> value_;  ///< one more
};

/// Minimum of the values put on chains that contain an event. Thread safe.
class ChainMinima {
public:
    explicit ChainMinima(const EventChains& events);
    void put(Chain chain, double value);
    /// After the last put: per event, infinity when there is none. Consumes the values.
    [[nodiscard]] IdArray<EventId, double> take();

private:
    const EventChains& events_;
    std::vector<double> node_;  ///< binary tree over positions: node i has the children 2 i and 2 i + 1, leaves start at size()
};

}  // namespace isoatlas
