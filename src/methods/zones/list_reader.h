// Reads the lists that a query opens.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "methods/disk/interval_tree_query.h"
#include "methods/zones/zone_cell.h"
#include "methods/zones/zone_directory.h"

namespace isoatlas {

/// One list after another; those that share a block, one read. Adds what it reads to cost and reads.
template <class T>
class ListReader {
public:
    using Entry = ZoneCell<T>;

    ListReader(const BlockReader& file, const Extent& extent, double tau, CellSearchCost& cost, ZoneFileReads& reads)
        : file_(file),
          cells_(CellGrid<T>(extent, {}).count()),
          tau_(tau),
          cost_(cost),
          reads_(reads),
          short_(file, cost),
          trees_(file, tau, cost) {}

    void read(const ZoneList& list) {
        ++reads_.components;
        if (list.place.levels == 0) return read_short(list);
        const std::int64_t blocks = cost_.blocks, nodes = cost_.nodes;
        trees_.run(list.place, [this](const Entry& entry) { take(entry); });
        reads_.cells_loaded += (cost_.blocks - blocks - (cost_.nodes - nodes)) * entries_of_block<Entry>(file_.payload_bytes());
    }
    /// Ascending by cell, each once.
    [[nodiscard]] std::vector<Entry> result() {
        reads_.entries_active = std::ssize(found_);
        std::ranges::sort(found_, {}, &Entry::cell);
        const auto repeated = std::ranges::unique(found_, {}, &Entry::cell);
        found_.erase(repeated.begin(), repeated.end());
        return std::move(found_);
    }

private:
    /// From the highest down to the first below tau.
    void read_short(const ZoneList& list) {
        short_.check(list.place.list);
        reads_.cells_loaded += list.place.list.count;
        for (std::int64_t i = 0; i < list.place.list.count; ++i) {
            ++cost_.cells;
            const Entry entry = short_.entry(list.place.list.first + i);
            if (!entry.reaches(tau_)) return;
            if (entry.begins_below(tau_)) take(entry);
        }
    }
    void take(const Entry& entry) {
        if (entry.cell.number() >= cells_) file_.fail("a cell lies outside of the volume");
        found_.push_back(entry);
    }

    const BlockReader& file_;
    std::int64_t cells_;  ///< of the volume
    double tau_;
    CellSearchCost& cost_;
    ZoneFileReads& reads_;
    EntryReader<Entry> short_;
    IntervalTreeQuery<Entry> trees_;
    std::vector<Entry> found_;
};

}  // namespace isoatlas
