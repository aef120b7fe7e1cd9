// The criticality tree of a file of zones, as a query walks it.
//
// Its nodes own the lists: events (by zone), or heavy paths of events (by path). A node is active at tau in (low, high]; the nodes above it
// in space and value, its children, begin where it, or an event on its path, ends.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "census/event_chains.h"
#include "isoatlas/zone_files.h"
#include "methods/zones/block_stream.h"

namespace isoatlas {

using ZoneNodeId = StrongId<struct ZoneNodeTag, std::uint32_t>;

/// The events as they are stored.
struct StoredTree {
    std::vector<double> values;         ///< children come before their parent
    std::vector<std::int64_t> parents;  ///< that of the root: the number of events
    std::vector<std::int64_t> heads;    ///< of the heavy path: its event nearest to the root
};
void put_tree(StreamWriter& stream, const EventChains& events);
/// Throws Error{input}: no tree.
[[nodiscard]] StoredTree get_tree(PayloadReader& payload, const BlockReader& file);

/// Per event: the node that owns its cells. Nodes are numbered in the order of their events nearest to the root.
struct NodesOfEvents {
    IdArray<EventId, ZoneNodeId> node;
    std::size_t count = 0;  ///< of nodes
};
[[nodiscard]] NodesOfEvents nodes_of_events(const EventChains& events, ZoneLayout layout);
[[nodiscard]] NodesOfEvents nodes_of_events(const StoredTree& tree, ZoneLayout layout);

class ZoneTree {
public:
    ZoneTree(const StoredTree& tree, ZoneLayout layout);

    [[nodiscard]] std::int64_t size() const { return static_cast<std::int64_t>(nodes_.size()); }
    [[nodiscard]] std::int64_t bytes() const;
    /// Calls visit(node) for the active ones; from the root, nodes that begin below tau. Returns how many it has visited.
    template <class Visit>
    std::int64_t for_active(double tau, const Visit& visit) const {
        std::int64_t visited = 0;
        std::vector<ZoneNodeId> open;
        const auto add = [&](std::span<const ZoneNodeId> children) {
            for (const ZoneNodeId child : children) {
                if (!(nodes_[child.index()].low < tau)) return;  // they are sorted
                open.push_back(child);
            }
        };
        add(children_of(nodes_.size()));
        for (; !open.empty(); ++visited) {
            const ZoneNodeId node = open.back();
            open.pop_back();
            if (tau <= nodes_[node.index()].high) visit(node);
            add(children_of(node.index()));
        }
        return visited;
    }

private:
    struct Node {
        double low = -std::numeric_limits<double>::infinity(), high = low;
    };
    /// One more: of no node.
    [[nodiscard]] std::span<const ZoneNodeId> children_of(std::size_t node) const {
        return std::span(children_).subspan(first_child_[node], first_child_[node + 1] - first_child_[node]);
    }

    std::vector<Node> nodes_;
    std::vector<std::size_t> first_child_;
    std::vector<ZoneNodeId> children_;  ///< of each node together, ascending by where they begin
};

}  // namespace isoatlas
