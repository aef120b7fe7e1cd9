// ListWriter: lists of cells into the file, short ones one after another, none in two blocks, and longer ones as interval trees.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "methods/disk/interval_tree_writer.h"
#include "methods/zones/filing_runs.h"
#include "methods/zones/zone_directory.h"

namespace isoatlas {

template <class T>
class ListWriter {
public:
    using Entry = ZoneCell<T>;

    ListWriter(BlockWriter& file, const Context& context)
        : file_(file), context_(context), in_block_(static_cast<std::size_t>(entries_of_block<Entry>(file.payload_bytes()))) {}

    /// Of one component, which may lie in the scratch file. Cells that are never active have no entry.
    [[nodiscard]] ZoneList write(std::span<const Filing<T>> cells) {
        ZoneList list;
        list.filed = static_cast<std::uint32_t>(cells.size());
        T low = std::numeric_limits<T>::max(), high = std::numeric_limits<T>::lowest();
        for_each_entry<Filing<T>>(cells, [&](const Filing<T>& filing) {
            list.node = filing.node;
            if (!(filing.cell.low < filing.cell.high)) return;
            ++list.count, low = std::min(low, filing.cell.low), high = std::max(high, filing.cell.high);
        });
        if (list.count == 0) return list;
        list.low = static_cast<double>(low), list.high = static_cast<double>(high);
        Array<Entry> entries(list.count);
        PartWriters<Entry> writer({entries.data(), entries.size()}, kFromTheFirst);
        for_each_entry<Filing<T>>(cells, [&](const Filing<T>& filing) {
            if (filing.cell.low < filing.cell.high) writer.put(0, filing.cell);
        });
        writer.finish();
        if (list.count <= in_block_) {
            std::ranges::sort(entries, [](const Entry& p, const Entry& q) {
                return std::tuple(q.high, q.low, p.cell) < std::tuple(p.high, p.low, q.cell);
            });
            list.place.list = put(entries);
        } else {
            flush();
            list.place = IntervalTreeWriter<Entry>(file_).write(std::move(entries), context_);
        }
        return list;
    }
    /// After the last list.
    void flush() {
        if (short_) short_->flush();
        short_.reset();
    }

private:
    static constexpr std::array<std::size_t, 1> kFromTheFirst{0};  ///< one part

    [[nodiscard]] EntryRange put(std::span<const Entry> entries) {
        const std::int64_t size = std::ssize(entries), in_block = static_cast<std::int64_t>(in_block_);
        if (short_ && short_->ranges(std::span(&size, 1)).front().first % in_block + size > in_block) flush();
        if (!short_) short_.emplace(file_);
        return short_->put(entries);
    }

    BlockWriter& file_;
    const Context& context_;
    std::size_t in_block_;
    std::optional<EntryStream<Entry>> short_;
};

}  // namespace isoatlas
