// FilingRuns: which cell is in which list, for all lists. Filings come in the order of the cells and are read list by list: they are sorted
// in runs, which lie in the scratch file where memory is limited, and merged.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/big_vector.h"
#include "base/external_sort.h"
#include "base/paced_fill.h"
#include "isoatlas/error.h"
#include "methods/zones/zone_cell.h"
#include "methods/zones/zone_tree.h"

namespace isoatlas {

/// A cell in the list of a node.
template <class T>
struct Filing {
    ZoneCell<T> cell;
    ZoneNodeId node;
    std::uint8_t points;  ///< by zone: which of its corners are points of the zone, a bit each

    bool operator<(const Filing& other) const { return node != other.node ? node < other.node : cell.cell < other.cell.cell; }
};

/// How many there may be: more are refused as they come.
template <class T>
class FilingLimit {
public:
    /// path: of the volume.
    FilingLimit(std::int64_t max, const std::string& path) : max_(max), path_(path) {}
    /// Thread safe. Throws Error{resource}.
    void add(std::int64_t filings) {
        const std::int64_t count = count_ += filings;
        if (count > max_) refuse();
    }
    [[nodiscard]] std::int64_t count() const { return count_; }

private:
    [[noreturn]] void refuse() const {
        constexpr std::int64_t kMillion = 1000000;
        const std::int64_t bytes = max_ * EntryForm<ZoneCell<T>>::kBytes;
        throw Error(ErrorKind::resource, {.where = path_,
                                          .what = "the lists would have more than " + std::to_string(max_) + " entries, a file of " +
                                                  std::to_string(bytes / kMillion) + " MB at the least",
                                          .expected = "at most " + std::to_string(max_) + " entries",
                                          .next = "write them by path, allow more entries, or take a part of the volume"});
    }

    std::atomic<std::int64_t> count_ = 0;
    std::int64_t max_;
    const std::string& path_;
};

template <class T>
class FilingRuns {
public:
    /// So many nodes; threads: that add.
    FilingRuns(std::size_t nodes, int threads)
        : in_run_(memory_is_limited() ? std::clamp(sortable_items<Filing<T>>(threads), kMinRun, kMaxRun) : kMaxRun),
          sizes_(filled(nodes, std::uint32_t{0})) {}

    /// Thread safe. A cell is added once for a node.
    void add(std::span<const Filing<T>> filings) {
        std::vector<Filing<T>> run = take_open();
        run.insert(run.end(), filings.begin(), filings.end());
        if (run.size() >= in_run_) store(run);
        give_open(std::move(run));
    }

    /// Calls visit(filings) for the list of each node that has any, by node; filings: by cell, in an array that is given up, which may lie
    /// in the scratch file.
    template <class Visit>
    void for_lists(const Visit& visit) {
        for (std::vector<Filing<T>>& run : open_) store(run);
        open_.clear();
        std::vector<std::span<const Filing<T>>> runs(runs_.begin(), runs_.end());
        List list;
        merge_runs<Filing<T>>(runs, std::less<Filing<T>>(), [&](const Filing<T>& filing) {
            if (list.is_full()) list = List(sizes_[filing.node.index()]);
            list.put(filing);
            if (list.is_full()) visit(list.finish());
        });
    }

private:
    static constexpr std::size_t kMinRun = kMinScratch / sizeof(Filing<T>) + 1;  ///< fewer would stay in memory
    static constexpr std::size_t kMaxRun = std::size_t{1} << 20;

    /// The list that is being read.
    class List {
    public:
        explicit List(std::size_t size = 0) : filings_(size), buffered_(buffered_items<Filing<T>>(1)) {}
        [[nodiscard]] bool is_full() const { return written_ + buffer_.size() == filings_.size(); }
        void put(const Filing<T>& filing) {
            buffer_.push_back(filing);
            if (buffer_.size() == buffered_) flush();
        }
        [[nodiscard]] std::span<Filing<T>> finish() {
            flush();
            return filings_;
        }

    private:
        void flush() {
            write_part<Filing<T>>(std::span(filings_).subspan(written_, buffer_.size()), buffer_);
            written_ += buffer_.size();
            buffer_.clear();
        }
        Array<Filing<T>> filings_;
        std::vector<Filing<T>> buffer_;
        std::size_t written_ = 0, buffered_;
    };

    [[nodiscard]] std::vector<Filing<T>> take_open() {
        const std::lock_guard lock(mutex_);
        if (open_.empty()) return {};
        std::vector<Filing<T>> run = std::move(open_.back());
        open_.pop_back();
        return run;
    }
    void give_open(std::vector<Filing<T>> run) {
        const std::lock_guard lock(mutex_);
        open_.push_back(std::move(run));
    }
    /// Leaves the run empty.
    void store(std::vector<Filing<T>>& run) {
        std::ranges::sort(run, std::less<Filing<T>>());
        Array<Filing<T>> stored(run.size());
        write_part<Filing<T>>(stored, run);
        const std::lock_guard lock(mutex_);
        for (const Filing<T>& filing : run) ++sizes_[filing.node.index()];
        runs_.push_back(std::move(stored));
        run.clear();
    }

    std::size_t in_run_;
    Array<std::uint32_t> sizes_;  ///< per node
    std::mutex mutex_;
    std::vector<std::vector<Filing<T>>> open_;
    std::vector<Array<Filing<T>>> runs_;
};

}  // namespace isoatlas
