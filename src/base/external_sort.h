// External merge sort: runs that fit in memory are sorted one by one, then merged through small buffers (part_streams.h).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/memory_limit.h"
#include "base/parallel.h"
#include "base/part_streams.h"
#include "base/sort_by_steps.h"

namespace isoatlas {

/// Items that a thread may sort at once: with the copy and the places of sort_by_steps() a small share of the limit.
template <class T>
[[nodiscard]] std::size_t sortable_items(int threads) {
    constexpr std::size_t kShare = 32, kMin = std::size_t{1} << 10;
    const std::size_t bytes = static_cast<std::size_t>(memory_limit()) / kShare / static_cast<std::size_t>(thread_count(threads));
    return std::max(kMin, bytes / (2 * sizeof(T) + sizeof(std::size_t)));
}

/// Calls visit(item) for the items of all runs in order. runs: each in order; before(p, q): strict, items of which neither comes before
/// the other come in any order. Cost: O(n log runs).
template <class T, class Before, class Visit>
void merge_runs(std::span<const std::span<const T>> runs, const Before& before, const Visit& visit) {
    struct Head {
        T item;
        std::size_t run;
    };
    const auto later = [&](const Head& p, const Head& q) { return before(q.item, p.item); };
    PartReaders<T> readers(runs);
    std::vector<Head> heads;
    heads.reserve(runs.size());
    for (std::size_t run = 0; run < runs.size(); ++run) {
        if (readers.has_next(run)) heads.push_back({readers.next(run), run});
    }
    std::make_heap(heads.begin(), heads.end(), later);
    BudgetPoll memory;
    while (!heads.empty()) {
        memory.step();
        std::pop_heap(heads.begin(), heads.end(), later);
        Head& first = heads.back();
        visit(first.item);
        if (readers.has_next(first.run)) {
            first.item = readers.next(first.run);
            std::push_heap(heads.begin(), heads.end(), later);
        } else {
            heads.pop_back();
        }
    }
}

/// Sorts an array in the scratch file that is too large for memory into runs of so many items. Returns the runs.
template <class T, class Key, class Before>
[[nodiscard]] std::vector<std::span<const T>> sort_runs(int threads, std::span<T> all, std::size_t items, const Key& key,
                                                        const Before& before) {
    std::vector<std::span<const T>> runs((all.size() + items - 1) / items);
    for_each_block(threads, static_cast<std::int64_t>(runs.size()), [&](std::int64_t run) {
        const std::span<T> part = all.subspan(run * items, std::min(items, all.size() - run * items));
        change_part(part, [&](std::span<T> some) { sort_by_steps(some, key, before); });
        runs[run] = part;
    });
    return runs;
}

/// The same, and passes the items in order to put(place of the first, items), several at a time.
template <class T, class Key, class Before, class Put>
void sort_large(int threads, std::span<T> all, std::size_t items, const Key& key, const Before& before, const Put& put) {
    const std::vector<std::span<const T>> runs = sort_runs(threads, all, items, key, before);
    std::vector<T> some;
    std::size_t place = 0;
    const auto flush = [&] {
        put(place, std::span<const T>(some));
        place += some.size();
        some.clear();
    };
    const std::size_t together = buffered_items<T>(1);
    some.reserve(together);
    merge_runs<T>(runs, before, [&](const T& item) {
        some.push_back(item);
        if (some.size() == together) flush();
    });
    flush();
}

}  // namespace isoatlas
