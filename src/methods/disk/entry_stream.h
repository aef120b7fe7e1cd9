// EntryStream: entries of an interval tree on their way into blocks, and arrays of entries that may lie in the scratch file.
#pragma once

#include <algorithm>
#include <numeric>
#include <span>
#include <vector>

#include "base/external_sort.h"
#include "base/part_streams.h"
#include "base/streamed.h"
#include "methods/disk/interval_tree_format.h"

namespace isoatlas {

/// Orders of entries along one axis of the span space, ties by number.
template <class Entry>
struct LowFirst {
    static double key(const Entry& entry) { return static_cast<double>(entry.low); }
    bool operator()(const Entry& p, const Entry& q) const {
        return p.low != q.low ? p.low < q.low : EntryForm<Entry>::number(p) < EntryForm<Entry>::number(q);
    }
};
template <class Entry>
struct HighFirst {
    static double key(const Entry& entry) { return -static_cast<double>(entry.high); }
    bool operator()(const Entry& p, const Entry& q) const {
        return p.high != q.high ? p.high > q.high : EntryForm<Entry>::number(p) < EntryForm<Entry>::number(q);
    }
};

/// Calls visit(entry) for all, with a look at the memory budget on the way.
template <class Entry, class Visit>
void for_each_entry(std::span<const Entry> entries, const Visit& visit) {
    std::vector<Entry> buffer;
    for (const Block block : streamed_blocks(entries.size(), buffered_items<Entry>(1))) {
        for (const Entry& entry : part_in_memory(entries.subspan(block.first, block.size()), buffer)) visit(entry);
    }
}

/// Sorts entries and passes them to put(place of the first, entries), several at a time. Changes their array.
template <class Order, class Entry, class Put>
void put_in_order(std::span<Entry> entries, const Put& put) {
    if (is_scratch(entries.data())) {
        sort_large(1, entries, sortable_items<Entry>(1), Order::key, Order(), put);
    } else {
        sort_by_steps(entries, Order::key, Order());
        put(std::size_t{0}, std::span<const Entry>(entries));
    }
}

/// Entries dealt to lists of known sizes, which lie one after the other in an array.
template <class Entry>
class DealtLists {
public:
    /// into: room for all.
    DealtLists(std::span<Entry> into, std::span<const std::int64_t> sizes) : writers_(into, firsts(sizes)) {}
    void put(std::size_t list, const Entry& entry) { writers_.put(list, entry); }
    void finish() { writers_.finish(); }

private:
    static std::vector<std::size_t> firsts(std::span<const std::int64_t> sizes) {
        std::vector<std::size_t> first(sizes.size());
        std::exclusive_scan(sizes.begin(), sizes.end(), first.begin(), std::size_t{0});
        return first;
    }
    PartWriters<Entry> writers_;
};

/// One entry after the other, from the next block of the file on.
template <class Entry>
class EntryStream {
public:
    explicit EntryStream(BlockWriter& file)
        : file_(file), in_block_(entries_of_block<Entry>(file.payload_bytes())), next_(file.blocks() * in_block_) {}

    void put(const Entry& entry) {
        EntryForm<Entry>::put(block_, entry);
        if (++next_ % in_block_ == 0) flush();
    }
    EntryRange put(std::span<const Entry> entries) {
        const EntryRange range{next_, static_cast<std::uint32_t>(entries.size())};
        for_each_entry(entries, [this](const Entry& entry) { put(entry); });
        return range;
    }
    /// Where lists of these sizes will be that are put next, one after the other.
    [[nodiscard]] std::vector<EntryRange> ranges(std::span<const std::int64_t> sizes) const {
        std::vector<EntryRange> lists;
        std::int64_t at = next_;
        for (const std::int64_t size : sizes) {
            lists.push_back({at, static_cast<std::uint32_t>(size)});
            at += size;
        }
        return lists;
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

}  // namespace isoatlas
