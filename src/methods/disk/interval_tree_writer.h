// Writes an I/O-optimal interval tree (interval_tree_format.h), level by level: each is a pass over the entries that are left.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "base/big_vector.h"
#include "base/cancel.h"
#include "methods/disk/interval_tree_format.h"

namespace isoatlas {

/// Orders of entries along one axis of the span space, ties by number.
template <class Entry>
struct LowFirst {
    bool operator()(const Entry& p, const Entry& q) const {
        return p.low != q.low ? p.low < q.low : EntryForm<Entry>::number(p) < EntryForm<Entry>::number(q);
    }
};
template <class Entry>
struct HighFirst {
    bool operator()(const Entry& p, const Entry& q) const {
        return p.high != q.high ? p.high > q.high : EntryForm<Entry>::number(p) < EntryForm<Entry>::number(q);
    }
};

/// One entry after the other, from the next block of the file on.
template <class Entry>
class EntryStream {
public:
    explicit EntryStream(BlockWriter& file)
        : file_(file), in_block_(entries_of_block<Entry>(file.payload_bytes())), next_(file.blocks() * in_block_) {}

    /// Number of the next entry.
    [[nodiscard]] std::int64_t next() const { return next_; }
    void put(const Entry& entry) {
        EntryForm<Entry>::put(block_, entry);
        if (++next_ % in_block_ == 0) flush();
    }
    [[nodiscard]] EntryRange put_all(std::span<const Entry> entries) {
        const EntryRange range{next_, static_cast<std::uint32_t>(entries.size())};
        for (const Entry& entry : entries) put(entry);
        return range;
    }
    /// After the last entry.
    void flush() {
        if (!block_.bytes().empty()) (void)file_.add(block_.bytes());
        block_.clear();
    }

private:
    BlockWriter& file_;
    std::int64_t in_block_, next_;
    PayloadWriter block_;
};

template <class Entry>
class IntervalTreeWriter {
public:
    explicit IntervalTreeWriter(BlockWriter& file)
        : file_(file),
          in_block_(static_cast<std::size_t>(entries_of_block<Entry>(file.payload_bytes()))),
          slabs_(slabs_of<Entry>(file.payload_bytes())),
          stream_(file) {}

    /// Children of a node.
    [[nodiscard]] int slabs() const { return slabs_; }

    /// Writes the tree of these entries, low < high each, at the end of the file. Called once. Throws Error: resource, cancelled.
    [[nodiscard]] IntervalTreePlace write(Array<Entry> entries, const Context& context) {
        if (entries.size() <= in_block_) {
            const IntervalTreePlace place{.list = stream_.put_all(entries)};
            stream_.flush();
            return place;
        }
        std::ranges::sort(entries, LowFirst<Entry>());
        Array<Entry> rest(entries.size());
        IntervalTreePlace place;
        for (std::vector<Part> level{{0, entries.size()}}; !level.empty(); ++place.levels) {
            std::vector<Part> next;
            for (const Part& part : level) {
                stop_if_cancelled(context);
                divide(std::span(entries).subspan(part.first, part.count), std::span(rest).subspan(part.first, part.count), part.first,
                       next);
            }
            level = std::move(next);
            std::swap(entries, rest);
        }
        stream_.flush();
        place.root = file_.blocks();
        for (const PayloadWriter& node : nodes_) (void)file_.add(node.bytes());
        return place;
    }

private:
    /// The entries of a node and of all below it: so many from there on.
    struct Part {
        std::size_t first, count;
    };

    /// Makes the node of some entries, in order of their low ends: lists those that stay with it, and moves the others to rest, child by
    /// child, in the same order. offset: of the entries in their array.
    void divide(std::span<const Entry> entries, std::span<Entry> rest, std::size_t offset, std::vector<Part>& next) {
        TreeNode node;
        node.keys = keys_of(entries);
        const auto slabs = static_cast<std::size_t>(node.slabs());
        std::vector<std::vector<Entry>> inside(slabs), left(slabs), right(slabs), multi((slabs - 1) * (slabs - 2) / 2);
        for (const Entry& entry : entries) {
            const int p = slab_of(node.keys, static_cast<double>(entry.low)), q = slab_of(node.keys, static_cast<double>(entry.high));
            if (p == q) {
                inside[static_cast<std::size_t>(p)].push_back(entry);
                continue;
            }
            left[static_cast<std::size_t>(p)].push_back(entry);
            right[static_cast<std::size_t>(q)].push_back(entry);
            if (q - p > 1) multi[place_of_multi(p + 1, q - 1, node.slabs())].push_back(entry);
        }
        for (const auto& list : left) node.left.push_back(stream_.put_all(list));
        for (auto& list : right) std::ranges::sort(list, HighFirst<Entry>()), node.right.push_back(stream_.put_all(list));
        for (const auto& list : multi) node.multi.push_back(stream_.put_all(list));
        std::size_t place = 0;
        for (const auto& list : inside) {
            TreeChild child;
            if (list.size() <= in_block_) {
                child.list = stream_.put_all(list);
            } else {
                child.node = ++last_node_;
                std::ranges::copy(list, rest.begin() + static_cast<std::ptrdiff_t>(place));
                next.push_back({offset + place, list.size()});
                place += list.size();
            }
            node.children.push_back(child);
        }
        nodes_.push_back(payload_of(node));
    }

    /// Low ends, as many entries between one and the next. A slab has its key as its end, and an entry in it begins below: so a child has
    /// at most one entry of as many as there are slabs.
    [[nodiscard]] std::vector<double> keys_of(std::span<const Entry> entries) const {
        std::vector<double> keys;
        for (int i = 1; i < slabs_; ++i) {
            const auto key =
                static_cast<double>(entries[entries.size() * static_cast<std::size_t>(i) / static_cast<std::size_t>(slabs_)].low);
            if (keys.empty() || key > keys.back()) keys.push_back(key);
        }
        return keys;
    }

    BlockWriter& file_;
    std::size_t in_block_;
    int slabs_;
    EntryStream<Entry> stream_;
    std::int64_t last_node_ = 0;  ///< that has a number; the root is 0, and numbers are those of the order in which nodes are made
    std::vector<PayloadWriter> nodes_;
};

}  // namespace isoatlas
