#include "methods/zones/zone_tree.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "base/streamed.h"

namespace isoatlas {

namespace {

/// head(e): of the heavy path of an event.
template <class Head>
NodesOfEvents number_nodes(std::size_t events, ZoneLayout layout, const Head& head) {
    NodesOfEvents nodes{IdArray<EventId, ZoneNodeId>(events), 0};
    for (const EventId e : streamed<EventId>(events, in_order(2))) {
        if (layout == ZoneLayout::by_zone || head(e) == e) nodes.node[e] = ZoneNodeId(nodes.count++);
    }
    if (layout == ZoneLayout::by_path) {
        for (const EventId e : streamed<EventId>(events, in_order(2))) nodes.node[e] = nodes.node[head(e)];
    }
    return nodes;
}

/// A number of each event, as an array.
template <class Number>
void put_numbers(StreamWriter& stream, std::int64_t events, const Number& number) {
    stream.put(events);
    for (const EventId e : streamed<EventId>(static_cast<std::size_t>(events), in_order(1))) stream.put(number(e));
}

}  // namespace

void put_tree(StreamWriter& stream, const EventChains& events) {
    put_numbers(stream, events.size(), [&](EventId e) { return events.value(e); });
    put_numbers(stream, events.size(), [&](EventId e) { return std::int64_t{events.below(e).number()}; });
    put_numbers(stream, events.size(), [&](EventId e) { return std::int64_t{events.head(e).number()}; });
}

StoredTree get_tree(PayloadReader& payload, const BlockReader& file) {
    StoredTree tree;
    get_array(payload, file, tree.values), get_array(payload, file, tree.parents), get_array(payload, file, tree.heads);
    const auto events = std::ssize(tree.values);
    if (std::ssize(tree.parents) != events || std::ssize(tree.heads) != events) file.fail("the tree has tables of different lengths");
    if (events == 0) file.fail("the tree has no event");
    for (std::int64_t e = 0; e < events; ++e) {
        const auto i = static_cast<std::size_t>(e);
        if (tree.parents[i] <= e || tree.parents[i] > events || tree.heads[i] < e || tree.heads[i] >= events)
            file.fail("the tree has an event that follows none");
    }
    return tree;
}

NodesOfEvents nodes_of_events(const EventChains& events, ZoneLayout layout) {
    return number_nodes(static_cast<std::size_t>(events.size()), layout, [&](EventId e) { return events.head(e); });
}
NodesOfEvents nodes_of_events(const StoredTree& tree, ZoneLayout layout) {
    return number_nodes(tree.heads.size(), layout, [&](EventId e) { return EventId(tree.heads[e.index()]); });
}

ZoneTree::ZoneTree(const StoredTree& tree, ZoneLayout layout) {
    const NodesOfEvents nodes = nodes_of_events(tree, layout);
    const std::span<const ZoneNodeId> owner = nodes.node.items();
    const std::size_t events = owner.size();
    nodes_.resize(nodes.count);
    std::vector<std::size_t> parent(nodes_.size(), nodes_.size());
    for (std::size_t e = 0; e < events; ++e) {
        Node& node = nodes_[owner[e].index()];
        node.high = std::max(node.high, tree.values[e]);
        const auto below = static_cast<std::size_t>(tree.parents[e]);
        if (below == events || owner[below] == owner[e]) continue;
        node.low = tree.values[below];
        parent[owner[e].index()] = owner[below].index();
    }
    first_child_.assign(nodes_.size() + 2, 0);
    for (const std::size_t p : parent) ++first_child_[p + 1];
    std::partial_sum(first_child_.begin(), first_child_.end(), first_child_.begin());
    std::vector<ZoneNodeId> order(nodes_.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = ZoneNodeId(i);
    std::ranges::sort(order, {}, [this](ZoneNodeId node) { return std::pair(nodes_[node.index()].low, node); });
    std::vector<std::size_t> next = first_child_;
    children_.resize(nodes_.size());
    for (const ZoneNodeId node : order) children_[next[parent[node.index()]]++] = node;
}

std::int64_t ZoneTree::bytes() const {
    return static_cast<std::int64_t>(nodes_.size() * sizeof(Node) + first_child_.size() * sizeof(std::size_t) +
                                     children_.size() * sizeof(ZoneNodeId));
}

}  // namespace isoatlas
