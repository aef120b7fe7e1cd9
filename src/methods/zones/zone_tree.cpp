#include "methods/zones/zone_tree.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "methods/zones/block_stream.h"

namespace isoatlas {

StoredTree stored_tree(const EventChains& events) {
    StoredTree tree;
    for (const EventId e : ids<EventId>(events.size())) {
        tree.values.push_back(events.value(e));
        tree.parents.push_back(events.below(e).number());
        tree.heads.push_back(events.head(e).number());
    }
    return tree;
}

void put_tree(PayloadWriter& payload, const StoredTree& tree) {
    put_array(payload, tree.values), put_array(payload, tree.parents), put_array(payload, tree.heads);
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

std::vector<ZoneNodeId> node_of_events(const StoredTree& tree, ZoneLayout layout) {
    std::vector<ZoneNodeId> node(tree.values.size());
    ZoneNodeId next(0);
    for (std::size_t e = 0; e < node.size(); ++e) {
        if (layout == ZoneLayout::by_zone || tree.heads[e] == static_cast<std::int64_t>(e)) node[e] = next, ++next;
    }
    for (std::size_t e = 0; e < node.size() && layout == ZoneLayout::by_path; ++e) node[e] = node[static_cast<std::size_t>(tree.heads[e])];
    return node;
}

ZoneTree::ZoneTree(const StoredTree& tree, ZoneLayout layout) {
    const std::vector<ZoneNodeId> owner = node_of_events(tree, layout);
    const std::size_t events = owner.size();
    for (const ZoneNodeId node : owner) nodes_.resize(std::max(nodes_.size(), node.index() + 1));
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
