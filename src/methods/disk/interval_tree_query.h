// A query of an I/O-optimal interval tree (interval_tree_format.h): a walk down one path.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "methods/disk/interval_tree_format.h"

namespace isoatlas {

/// Entries and nodes of a file: the block of the last entry stays in memory. Counts what it reads.
template <class Entry>
class EntryReader {
public:
    EntryReader(const BlockReader& file, CellSearchCost& cost)
        : file_(file), cost_(cost), in_block_(entries_of_block<Entry>(file.payload_bytes())) {}

    /// i: of a list that was checked.
    [[nodiscard]] Entry entry(std::int64_t i) {
        if (const std::int64_t block = i / in_block_; block != block_) {
            bytes_ = read(block);
            block_ = block;
        }
        PayloadReader payload(
            std::span<const std::byte>(bytes_).subspan(static_cast<std::size_t>(i % in_block_ * EntryForm<Entry>::kBytes)), file_);
        return EntryForm<Entry>::get(payload);
    }
    void check(const EntryRange& list) const { check_range(list, file_, file_.blocks() * in_block_); }
    [[nodiscard]] TreeNode node(std::int64_t block) { return node_of(read(block), file_, file_.blocks() * in_block_); }

private:
    [[nodiscard]] std::vector<std::byte> read(std::int64_t block) {
        ++cost_.blocks;
        cost_.bytes_read += file_.block_bytes();
        return file_.read(block);
    }

    const BlockReader& file_;
    CellSearchCost& cost_;
    std::int64_t in_block_, block_ = -1;
    std::vector<std::byte> bytes_;
};

/// Visits the active entries of one tree after the other.
template <class Entry>
class IntervalTreeQuery {
public:
    /// Adds what it looks at to cost: cells (entries), nodes, blocks, bytes_read.
    IntervalTreeQuery(const BlockReader& file, double tau, CellSearchCost& cost)
        : file_(file), tau_(tau), cost_(cost), reader_(file, cost) {}

    /// Calls visit(entry) for each, once. Throws Error{input}: the file is damaged.
    template <class Visit>
    void run(const IntervalTreePlace& tree, const Visit& visit) {
        reader_.check(tree.list);
        TreeChild at{tree.levels == 0 ? TreeChild::kNothing : 0, tree.list};
        for (std::int64_t levels = tree.levels; at.node != TreeChild::kNothing; --levels) {
            if (levels == 0 || at.node < 0) file_.fail("the tree has more levels than it should");
            ++cost_.nodes;
            const TreeNode node = reader_.node(tree.root + at.node);
            report(node, visit);
            at = node.children[static_cast<std::size_t>(slab_of(node.keys, tau_))];
        }
        scan(at.list, visit, [this](const Entry& e) { return Take{e.is_active(tau_), true}; });
    }

private:
    /// The active entries that belong to a node.
    template <class Visit>
    void report(const TreeNode& node, const Visit& visit) {
        const int slabs = node.slabs(), slab = slab_of(node.keys, tau_);
        const auto at = static_cast<std::size_t>(slab);
        scan(node.left[at], visit, [this](const Entry& e) { return Take{e.begins_below(tau_), e.begins_below(tau_)}; });
        scan(node.right[at], visit, [this](const Entry& e) { return Take{e.reaches(tau_), e.reaches(tau_)}; });
        for (int p = 1; p <= slab; ++p) {
            for (int q = std::max(p, slab); q <= slabs - 2; ++q)
                scan(node.multi[place_of_multi(p, q, slabs)], visit, [](const Entry&) { return Take{true, true}; });
        }
        if (slab == 0 || slab == slabs - 1) return;
        const double begin = node.keys[at - 1], end = node.keys[at];  // what begins or ends between them is in the other lists
        scan(node.corner[at], visit,
             [begin, end](const Entry& e) { return Take{static_cast<double>(e.low) <= begin && static_cast<double>(e.high) > end, true}; });
    }

    struct Take {
        bool is_active, goes_on;
    };
    /// Visits the active entries of a list until one says that none follows.
    template <class Visit, class Look>
    void scan(const EntryRange& list, const Visit& visit, const Look& look) {
        for (std::int64_t i = list.first; i < list.first + list.count; ++i) {
            ++cost_.cells;
            const Entry entry = reader_.entry(i);
            const Take take = look(entry);
            if (take.is_active) visit(entry);
            if (!take.goes_on) return;
        }
    }

    const BlockReader& file_;
    double tau_;
    CellSearchCost& cost_;
    EntryReader<Entry> reader_;
};

}  // namespace isoatlas
