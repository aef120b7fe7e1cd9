#include "tree/contour_tree.h"

#include <optional>
#include <utility>

#include "base/check.h"
#include "base/parallel.h"

namespace isoatlas {
namespace {

// One of the two trees while leaves are removed: parent, and the xor of the children (the child itself once only one is left).
template <class Id>
struct ShrinkingTree {
    BigVector<Id> parent;
    BigVector<Id> children_xor;

    explicit ShrinkingTree(BigVector<Id> parents) : parent(std::move(parents)), children_xor(parent.size(), Id{0}) {
        for (std::size_t x = 0; x < parent.size(); ++x) {
            if (!is_root(x)) children_xor[parent[x]] ^= static_cast<Id>(x);
        }
    }
    [[nodiscard]] bool is_root(std::size_t x) const { return parent[x] == static_cast<Id>(x); }

    void remove_leaf(std::size_t x) { children_xor[parent[x]] ^= static_cast<Id>(x); }
    /// x has exactly one child: it takes the place of x.
    void splice(std::size_t x) {
        const Id child = children_xor[x];
        if (is_root(x)) {
            parent[child] = child;
        } else {
            parent[child] = parent[x];
            children_xor[parent[x]] ^= static_cast<Id>(x) ^ child;
        }
    }
};

/// Numbers of children in both trees, packed: low two bits join (from above), next two split (from below).
template <class Id>
BigVector<std::uint8_t> child_counts(const ShrinkingTree<Id>& join, const ShrinkingTree<Id>& split) {
    BigVector<std::uint8_t> count(join.parent.size(), 0);
    for (std::size_t x = 0; x < count.size(); ++x) {
        if (!join.is_root(x)) count[join.parent[x]] += 1;
        if (!split.is_root(x)) count[split.parent[x]] += 4;
    }
    return count;
}

constexpr std::uint8_t kUpperLeaf = 4;  // nothing above, one below
constexpr std::uint8_t kLowerLeaf = 1;

}  // namespace

template <class Id>
ContourTree<Id> contour_tree(BigVector<Id> join_parents, BigVector<Id> split_parents, std::span<const std::int8_t> delta_chi, int threads) {
    using Signed = typename ContourTree<Id>::Signed;
    std::optional<ShrinkingTree<Id>> join_tree, split_tree;
    run_both(threads, [&] { join_tree.emplace(std::move(join_parents)); }, [&] { split_tree.emplace(std::move(split_parents)); });
    ShrinkingTree<Id>& join = *join_tree;
    ShrinkingTree<Id>& split = *split_tree;
    const std::size_t nodes = join.parent.size();
    BigVector<std::uint8_t> count = child_counts(join, split);
    ContourTree<Id> tree;
    tree.other.resize(nodes);
    tree.half_chi.assign(nodes, Signed{0});  // until its arc is made: sum(above) + delta_chi - sum(below) over the arcs made at the node
    if (!delta_chi.empty()) {
        for (std::size_t x = 0; x + 1 < nodes; ++x) tree.half_chi[x] = delta_chi[x];
        tree.half_chi[nodes - 1] = -1;  // the outside closes every contour like a minimum
    }

    std::size_t arcs = 0;
    Id last = static_cast<Id>(nodes - 1);
    for (std::size_t seed = 0; seed < nodes; ++seed) {
        // Follow the chain of leaves that this one uncovers; earlier seeds that become leaves are taken by the chain itself.
        for (std::size_t x = seed; count[x] == kUpperLeaf || count[x] == kLowerLeaf;) {
            const bool upper = count[x] == kUpperLeaf;
            ShrinkingTree<Id>& leaf_tree = upper ? join : split;
            ShrinkingTree<Id>& other_tree = upper ? split : join;
            const Id y = leaf_tree.parent[x];
            leaf_tree.remove_leaf(x);
            other_tree.splice(x);
            tree.other[x] = y;
            if (upper) {
                tree.half_chi[y] += tree.half_chi[x];
                count[y] = static_cast<std::uint8_t>(count[y] - 1);
            } else {
                tree.half_chi[x] = static_cast<Signed>(-tree.half_chi[x]);
                tree.half_chi[y] -= tree.half_chi[x];
                count[y] = static_cast<std::uint8_t>(count[y] - 4);
            }
            count[x] = 0xff;  // gone
            ++arcs;
            last = y;
            x = y;
        }
    }
    ISOATLAS_CHECK(arcs + 1 == nodes);
    tree.other[last] = last;
    ISOATLAS_CHECK(tree.half_chi[last] == 0);
    return tree;
}

template ContourTree<std::uint32_t> contour_tree(BigVector<std::uint32_t>, BigVector<std::uint32_t>, std::span<const std::int8_t>, int);
template ContourTree<std::uint64_t> contour_tree(BigVector<std::uint64_t>, BigVector<std::uint64_t>, std::span<const std::int8_t>, int);

}  // namespace isoatlas
