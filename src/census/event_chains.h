// Chains of the criticality tree: an event and some of its ancestors. Finds the event at which two chains meet.
//
// The tree is cut into heavy paths (every event continues the path of its child with most events above it), so the lowest common ancestor
// takes O(log events), and a chain is O(log events) ranges of positions.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "isoatlas/analysis.h"

namespace isoatlas {

/// The events from `top` towards the root, without `end`, which follows the last one (the number of events: up to the root).
struct Chain {
    std::int64_t top, end;
    bool operator==(const Chain&) const = default;
};

class EventChains {
public:
    /// Cost: O(events) time, 40 bytes an event.
    explicit EventChains(const Analysis& analysis);

    [[nodiscard]] std::int64_t size() const { return static_cast<std::int64_t>(head_.size()); }
    /// The parent; size() for the root.
    [[nodiscard]] std::int64_t below(std::int64_t event) const { return below_[static_cast<std::size_t>(event)]; }
    /// The critical value; -infinity for size().
    [[nodiscard]] double value(std::int64_t event) const { return value_[static_cast<std::size_t>(event)]; }
    /// The lowest common ancestor: the highest event that both become part of.
    [[nodiscard]] std::int64_t meeting(std::int64_t a, std::int64_t b) const;
    /// Position of an event on the heavy paths.
    [[nodiscard]] std::int64_t position(std::int64_t event) const { return position_[static_cast<std::size_t>(event)]; }

    /// Calls visit(first, last) for ranges of positions, both included, that make up the chain.
    template <class Visit>
    void for_ranges(Chain chain, const Visit& visit) const {
        std::int64_t event = chain.top;
        while (event != chain.end && event != size()) {
            const std::int64_t head = head_[static_cast<std::size_t>(event)];
            if (chain.end != size() && head_[static_cast<std::size_t>(chain.end)] == head) {
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
    std::vector<std::int64_t> below_, head_, position_;  ///< head: the event of its path that is nearest to the root
    std::vector<double> value_;                          ///< one more
};

/// Minimum of the values put on chains that contain an event. Thread safe.
class ChainMinima {
public:
    explicit ChainMinima(const EventChains& events);
    void put(Chain chain, double value);
    /// After the last put: per event, infinity when there is none. Consumes the values.
    [[nodiscard]] std::vector<double> take();

private:
    const EventChains& events_;
    std::vector<double> node_;  ///< binary tree over positions: node i has the children 2 i and 2 i + 1, leaves start at size()
};

}  // namespace isoatlas
