// Writes an I/O-optimal interval tree (interval_tree_format.h), level by level: a pass deals the entries that are left to the nodes of the
// next level, in their order. In memory or, where it is limited, in the scratch file: everything runs in order.
#pragma once

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "base/big_vector.h"
#include "base/cancel.h"
#include "methods/disk/entry_stream.h"
#include "methods/disk/node_lists.h"

namespace isoatlas {

/// Payloads of nodes in their order. Not in memory where that is limited.
class NodeSpool {
public:
    void add(const std::vector<std::byte>& payload) {
        constexpr std::size_t kChunk = std::size_t{1} << 22;
        if (chunks_.empty() || chunks_.back().size() + payload.size() > kChunk) {
            chunks_.emplace_back().reserve(kChunk);
            sizes_.emplace_back();
        }
        chunks_.back().insert(chunks_.back().end(), payload.begin(), payload.end());
        sizes_.back().push_back(payload.size());
    }
    void write_to(BlockWriter& file) const {
        for (const Block one : streamed_blocks(chunks_.size(), 1)) {
            const std::span<const std::byte> chunk(chunks_[one.first]);
            std::size_t at = 0;
            for (const std::size_t size : sizes_[one.first]) (void)file.add(chunk.subspan(std::exchange(at, at + size), size));
        }
    }

private:
    std::vector<Array<std::byte>> chunks_;
    std::vector<std::vector<std::size_t>> sizes_;
};

template <class Entry>
class IntervalTreeWriter {
public:
    explicit IntervalTreeWriter(BlockWriter& file)
        : file_(file),
          in_block_(entries_of_block<Entry>(file.payload_bytes())),
          slabs_(slabs_of<Entry>(file.payload_bytes())),
          stream_(file) {}

    /// Children of a node.
    [[nodiscard]] int slabs() const { return slabs_; }

    /// Writes the tree of these entries, low < high each, at the end of the file. Called once. Throws Error: resource, cancelled. Cost: two
    /// sorts of the entries, two passes over those that are left on each level; memory: a second copy of them.
    [[nodiscard]] IntervalTreePlace write(Array<Entry> entries, const Context& context) {
        IntervalTreePlace place;
        if (std::ssize(entries) <= in_block_) {
            place.list = stream_.put(entries);
            stream_.flush();
            return place;
        }
        Array<Entry> rest(entries.size());
        put_in_order<LowFirst<Entry>>(std::span(entries), [&](std::size_t first, std::span<const Entry> some) {
            stop_if_cancelled(context);
            write_part(std::span(rest).subspan(first, some.size()), some);
        });
        std::swap(entries, rest);
        for (std::vector<Part> level{{0, entries.size()}}; !level.empty(); ++place.levels) {
            std::vector<Part> next;
            for (const Part& part : level) {
                stop_if_cancelled(context);
                divide(part, std::span(entries).subspan(part.first, part.count), std::span(rest).subspan(part.first, part.count), next);
            }
            level = std::move(next);
            std::swap(entries, rest);
        }
        stream_.flush();
        place.root = file_.blocks();
        nodes_.write_to(file_);
        return place;
    }

private:
    /// The entries of a node and of all below it, in order of their low ends: so many from there on.
    struct Part {
        std::size_t first, count;
    };

    /// Makes the node of some entries: writes the lists of those that stay with it, and moves the others to rest, child by child. Both
    /// places are used up.
    void divide(const Part& part, std::span<Entry> entries, std::span<Entry> rest, std::vector<Part>& next) {
        TreeNode node;
        node.keys = keys_of(entries);
        NodeLists lists(node.slabs(), in_block_);
        for_each_entry<Entry>(entries, [&](const Entry& entry) { lists.count(slabs_of_ends(node.keys, entry)); });
        std::vector<std::int64_t> sizes = lists.inside;
        sizes.push_back(lists.own);
        DealtLists<Entry> dealt(rest, sizes);
        for_each_entry<Entry>(entries, [&](const Entry& entry) {
            const SlabPair slabs = slabs_of_ends(node.keys, entry);
            dealt.put(slabs.is_inside() ? static_cast<std::size_t>(slabs.p) : lists.inside.size(), entry);
        });
        dealt.finish();
        put_lists(node, lists, rest.last(static_cast<std::size_t>(lists.own)), entries);
        std::size_t first = 0;
        for (const std::int64_t inside : lists.inside) {
            const auto count = static_cast<std::size_t>(inside);
            if (inside <= in_block_) {
                node.children.push_back({TreeChild::kNothing, stream_.put(rest.subspan(first, count))});
            } else {
                node.children.push_back({++last_node_, {}});
                next.push_back({part.first + first, count});
            }
            first += count;
        }
        nodes_.add(payload_of(node).bytes());
    }

    /// own: of the node, by their low ends. spare: room for as many.
    void put_lists(TreeNode& node, const NodeLists& lists, std::span<Entry> own, std::span<Entry> spare) {
        node.left = stream_.ranges(lists.left);
        (void)stream_.put(own);
        put_long_lists(node, lists, own, spare);
        put_corner(node, lists, own);
        node.right = stream_.ranges(std::vector(lists.right.rbegin(), lists.right.rend()));
        std::ranges::reverse(node.right);
        put_in_order<HighFirst<Entry>>(own, [this](std::size_t, std::span<const Entry> some) { (void)stream_.put(some); });
    }

    void put_long_lists(TreeNode& node, const NodeLists& lists, std::span<const Entry> own, std::span<Entry> spare) {
        std::vector<std::int64_t> sizes(lists.multi.size(), 0);
        for (std::size_t list = 0; list < sizes.size(); ++list) sizes[list] = lists.is_short(list) ? 0 : lists.multi[list];
        node.multi = stream_.ranges(sizes);
        const auto all = static_cast<std::size_t>(std::reduce(sizes.begin(), sizes.end()));
        if (all == 0) return;
        DealtLists<Entry> dealt(spare, sizes);
        for_each_entry(own, [&](const Entry& entry) {
            const SlabPair slabs = slabs_of_ends(node.keys, entry);
            if (slabs.spans_slabs() && !lists.is_short(lists.multi_of(slabs))) dealt.put(lists.multi_of(slabs), entry);
        });
        dealt.finish();
        (void)stream_.put(spare.first(all));
    }

    void put_corner(TreeNode& node, const NodeLists& lists, std::span<const Entry> own) {
        const CornerStructure corner = lists.corner();
        const std::vector<EntryRange> parts = stream_.ranges(corner.sizes());
        node.corner.assign(static_cast<std::size_t>(node.slabs()), {});
        for (int slab = 1; slab + 1 < node.slabs(); ++slab) {
            const EntryRange &first = parts[corner.first_part(slab)], &last = parts[corner.last_part(slab)];
            node.corner[static_cast<std::size_t>(slab)] = {first.first, static_cast<std::uint32_t>(last.first + last.count - first.first)};
        }
        Array<Entry> all(static_cast<std::size_t>(std::reduce(corner.sizes().begin(), corner.sizes().end())));
        if (all.empty()) return;
        DealtLists<Entry> dealt(all, corner.sizes());
        for_each_entry(own, [&](const Entry& entry) {
            const SlabPair slabs = slabs_of_ends(node.keys, entry);
            if (!slabs.spans_slabs() || !lists.is_short(lists.multi_of(slabs))) return;
            corner.for_parts(slabs.p + 1, slabs.q - 1, [&](std::size_t part) { dealt.put(part, entry); });
        });
        dealt.finish();
        (void)stream_.put(all);
    }

    static SlabPair slabs_of_ends(const std::vector<double>& keys, const Entry& entry) {
        return {slab_of(keys, static_cast<double>(entry.low)), slab_of(keys, static_cast<double>(entry.high))};
    }

    /// Low ends, as many entries between one and the next. A slab has its key as its end, and an entry in it begins below: so of n entries
    /// in s slabs a child has at most n / s, however many are equal.
    [[nodiscard]] std::vector<double> keys_of(std::span<const Entry> entries) const {
        std::vector<double> keys;
        std::vector<Entry> buffer;
        for (int i = 1; i < slabs_; ++i) {
            const std::size_t at = entries.size() * static_cast<std::size_t>(i) / static_cast<std::size_t>(slabs_);
            const auto key = static_cast<double>(part_in_memory(entries.subspan(at, 1), buffer).front().low);
            if (keys.empty() || key > keys.back()) keys.push_back(key);
        }
        return keys;
    }

    BlockWriter& file_;
    std::int64_t in_block_;
    int slabs_;
    EntryStream<Entry> stream_;
    std::int64_t last_node_ = 0;  ///< that has a number; the root is 0, and numbers are those of the order in which nodes are made
    NodeSpool nodes_;
};

}  // namespace isoatlas
