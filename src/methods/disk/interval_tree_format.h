// How an I/O-optimal interval tree lies in a file of blocks (block_file.h), which may hold several trees and more.
//
// A node of the tree cuts the range of values at keys into slabs: slab i has the values v with key[i - 1] < v <= key[i]. An entry whose
// interval lies in one slab belongs to a child; any other to the node, in lists that lie one after the other in blocks of entries:
//   left[p]      of the slab of its low end, ascending by it: active in slab p as far as it begins below tau
//   right[q]     of the slab of its high end, descending by it: active in slab q as far as it reaches tau
//   multi[p, q]  of the first and last slab between both: active there, all of it
//   corner[i]    the multi lists with less than half a block of entries that are active in slab i, and others (corner_structure.h)
// A child with at most a block of entries is a list. Entries have numbers in the file: i is in block i / (entries of a block).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "methods/disk/block_file.h"
#include "methods/search/cell_grid.h"

namespace isoatlas {

/// An entry of a tree is active for low < tau <= high. How it lies in a block, and a number that orders entries with equal ends.
template <class Entry>
struct EntryForm;

template <class T>
struct EntryForm<CellInterval<T>> {
    static constexpr std::int64_t kBytes = 2 * sizeof(T) + sizeof(CellId::Number);
    static void put(PayloadWriter& to, const CellInterval<T>& c) { to.put(c.low), to.put(c.high), to.put(c.cell.number()); }
    [[nodiscard]] static CellInterval<T> get(PayloadReader& from) {
        const T low = from.get<T>(), high = from.get<T>();
        return {low, high, CellId(from.get<CellId::Number>())};
    }
    [[nodiscard]] static std::uint64_t number(const CellInterval<T>& c) { return c.cell.number(); }
};

/// Entries of a block.
template <class Entry>
[[nodiscard]] std::int64_t entries_of_block(std::int64_t payload_bytes) {
    return payload_bytes / EntryForm<Entry>::kBytes;
}

/// Entries first .. first + count - 1 of the file.
struct EntryRange {
    std::int64_t first = 0;
    std::uint32_t count = 0;
};

/// Where a tree is in its file: what its owner keeps.
struct IntervalTreePlace {
    std::int64_t levels = 0;  ///< of nodes; 0: a list alone
    std::int64_t root = 0;    ///< block of the first node; the others follow
    EntryRange list{};        ///< where there is no node
};

/// A child: a node, by its number in the tree, or a list.
struct TreeChild {
    static constexpr std::int64_t kNothing = -1;
    std::int64_t node = kNothing;
    EntryRange list{};
};

struct TreeNode {
    std::vector<double> keys;  ///< ascending, at least one
    std::vector<TreeChild> children;
    std::vector<EntryRange> left, right, corner, multi;
    [[nodiscard]] int slabs() const { return static_cast<int>(keys.size()) + 1; }
};

[[nodiscard]] inline int slab_of(const std::vector<double>& keys, double value) {
    return static_cast<int>(std::ranges::lower_bound(keys, value) - keys.begin());
}

/// Where multi[p, q] is, 1 <= p <= q <= slabs - 2: those of one p one after the other.
[[nodiscard]] inline std::size_t place_of_multi(int p, int q, int slabs) {
    const int lists_before = (p - 1) * (slabs - 1) - (p - 1) * p / 2;
    return static_cast<std::size_t>(lists_before + q - p);
}

/// Bytes of a node with so many slabs.
[[nodiscard]] constexpr std::int64_t node_bytes(std::int64_t slabs) {
    constexpr std::int64_t kRange = 12;
    return 8 + 8 * (slabs - 1) + (8 + kRange) * slabs + kRange * (3 * slabs + (slabs - 1) * (slabs - 2) / 2);
}

/// As many as the square root of the entries of a block, and as a node has room for.
template <class Entry>
[[nodiscard]] int slabs_of(std::int64_t payload_bytes) {
    auto slabs = static_cast<std::int64_t>(std::sqrt(static_cast<double>(entries_of_block<Entry>(payload_bytes))));
    while (slabs > 2 && node_bytes(slabs) > payload_bytes) --slabs;
    return static_cast<int>(std::max<std::int64_t>(2, slabs));
}

inline void put_range(PayloadWriter& to, const EntryRange& range) { to.put(range.first), to.put(range.count); }

[[nodiscard]] inline PayloadWriter payload_of(const TreeNode& node) {
    PayloadWriter payload;
    payload.put(static_cast<std::int64_t>(node.keys.size()));
    for (const double key : node.keys) payload.put(key);
    for (const TreeChild& child : node.children) payload.put(child.node), put_range(payload, child.list);
    for (const auto* lists : {&node.left, &node.right, &node.corner, &node.multi}) {
        for (const EntryRange& list : *lists) put_range(payload, list);
    }
    return payload;
}

/// Throws Error{input}: a list lies beyond so many entries.
inline void check_range(const EntryRange& list, const BlockReader& file, std::int64_t entries) {
    if (list.first < 0 || list.first > entries || list.count > entries - list.first) file.fail("a list lies outside of the file");
}

/// Throws Error{input}: it is no node, or a list lies beyond `entries`.
[[nodiscard]] inline TreeNode node_of(std::span<const std::byte> bytes, const BlockReader& file, std::int64_t entries) {
    PayloadReader payload(bytes, file);
    const auto keys = payload.get<std::int64_t>();
    if (keys < 1 || node_bytes(keys + 1) > file.payload_bytes()) file.fail("a node has no such lists");
    const auto range = [&] {
        EntryRange found;
        found.first = payload.get<std::int64_t>(), found.count = payload.get<std::uint32_t>();
        check_range(found, file, entries);
        return found;
    };
    TreeNode node;
    for (std::int64_t i = 0; i < keys; ++i) node.keys.push_back(payload.get<double>());
    for (std::int64_t i = 0; i <= keys; ++i) {
        const auto number = payload.get<std::int64_t>();
        node.children.push_back({number, range()});
    }
    for (auto* lists : {&node.left, &node.right, &node.corner}) {
        for (std::int64_t i = 0; i <= keys; ++i) lists->push_back(range());
    }
    for (std::int64_t i = 0; i < keys * (keys - 1) / 2; ++i) node.multi.push_back(range());
    return node;
}

}  // namespace isoatlas
