// Sorting on several threads: samples cut the keys into buckets, buckets are sorted on their own, small enough for the cache.
// The order must be strict and total: then the result does not depend on threads, chunks nor buckets.
// Keys that are all alike make one bucket: where memory is limited it is sorted in pieces that are merged (external_sort.h).
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/big_vector.h"
#include "base/external_sort.h"
#include "base/memory_limit.h"
#include "base/parallel.h"
#include "base/part_streams.h"
#include "base/sort_by_steps.h"

namespace isoatlas {

/// Cuts the real line into buckets of about equal numbers of keys.
class Buckets {
public:
    /// sample: some of the keys. buckets: at most 65535.
    Buckets(std::vector<double> sample, std::size_t buckets) : count_(buckets) {
        std::sort(sample.begin(), sample.end());
        for (std::size_t b = 1; b < buckets; ++b) splitters_.push_back(sample[b * sample.size() / buckets]);
        // Equal steps over the keys narrow a search down to the splitters within a step.
        constexpr std::size_t kSteps = 16;  // a bucket: most steps hold no splitter, and the search ends there
        steps_ = static_cast<double>(kSteps * buckets);
        first_of_step_.assign(kSteps * buckets + 2, 0);
        if (splitters_.empty()) return;
        low_ = splitters_.front();
        const double width = splitters_.back() - low_;
        factor_ = width > 0 && steps_ / width < 1e300 ? steps_ / width : 0;
        for (const double splitter : splitters_) ++first_of_step_[step_of(splitter) + 1];
        for (std::size_t s = 1; s < first_of_step_.size(); ++s) {
            first_of_step_[s] = static_cast<std::uint16_t>(first_of_step_[s] + first_of_step_[s - 1]);
        }
    }
    [[nodiscard]] std::size_t count() const { return count_; }
    /// Ascends with the key.
    [[nodiscard]] std::size_t of(double key) const {
        const std::size_t step = step_of(key);
        const auto begin = splitters_.begin() + first_of_step_[step], end = splitters_.begin() + first_of_step_[step + 1];
        return static_cast<std::size_t>(std::lower_bound(begin, end, key) - splitters_.begin());
    }

private:
    [[nodiscard]] std::size_t step_of(double key) const {
        return static_cast<std::size_t>(std::clamp((key - low_) * factor_, 0.0, steps_));
    }

    std::size_t count_;
    std::vector<double> splitters_;  // bucket b holds the keys in (splitter[b-1], splitter[b]]
    std::vector<std::uint16_t> first_of_step_;
    double steps_ = 0, low_ = 0, factor_ = 0;
};

/// `count` buckets of about as many items each, from a sample of the keys of n items.
template <class T, class Key>
Buckets buckets_of(const std::vector<BigVector<T>>& chunks, std::size_t n, std::size_t count, const Key& key) {
    constexpr std::size_t kSampled = 16;
    std::vector<double> sample;
    const std::size_t stride = std::max<std::size_t>(1, n / (kSampled * count));
    BudgetPoll memory;
    for (const BigVector<T>& chunk : chunks) {
        for (std::size_t i = 0; i < chunk.size(); i += stride) {
            memory.step(stride * sizeof(T));
            sample.push_back(key(chunk[i]));
        }
    }
    return {std::move(sample), count};
}

/// The items of the chunks, which it consumes, bucket after bucket. first[b]: where bucket b begins; the last is their number.
template <class T, class BucketOf>
BigVector<T> scatter(int threads, std::vector<BigVector<T>>& chunks, const BucketOf& bucket_of, std::span<std::size_t> first) {
    constexpr std::size_t kGroups = 8;
    const std::size_t groups = std::min(chunks.size(), kGroups * static_cast<std::size_t>(thread_count(threads)));
    const std::size_t count = first.size() - 1;
    std::vector<std::size_t> place(groups * count, 0);
    const auto for_chunks_of = [&](std::int64_t g, const auto& visit) {
        for (std::size_t c = g * chunks.size() / groups; c < (g + 1) * chunks.size() / groups; ++c) visit(chunks[c]);
    };
    for_each_block(threads, static_cast<std::int64_t>(groups), [&](std::int64_t g) {
        BudgetPoll memory;
        for_chunks_of(g, [&](const BigVector<T>& chunk) {
            for (const T& item : chunk) {
                memory.step();
                ++place[g * count + bucket_of(item)];
            }
        });
    });
    std::size_t next = 0;
    for (std::size_t b = 0; b < count; ++b) {
        first[b] = next;
        for (std::size_t g = 0; g < groups; ++g) next += std::exchange(place[g * count + b], next);
    }
    first[count] = next;
    BigVector<T> sorted(next);
    for_each_block(threads, static_cast<std::int64_t>(groups), [&](std::int64_t g) {
        BudgetPoll memory;
        PartWriters<T> writers(sorted, std::span(place).subspan(g * count, count));
        for_chunks_of(g, [&](BigVector<T>& chunk) {
            for (const T& item : chunk) {
                memory.step();
                writers.put(bucket_of(item), item);
            }
            release(chunk);
        });
        writers.finish();
    });
    return sorted;
}

/// Passes all items of the chunks to put(place of the first, items), sorted by before(p, q), which must agree with key (a double): key(p) <
/// key(q) implies before(p, q). allocate(n) is called once, before the first put. Puts come from several threads, in any order. Consumes
/// the chunks. Cost: O(n log n) time, a second copy of the items.
template <class T, class Key, class Before, class Allocate, class Put>
void sort_chunks(int threads, std::vector<BigVector<T>> chunks, const Key& key, const Before& before, const Allocate& allocate,
                 const Put& put) {
    constexpr std::size_t kBucket = 1 << 10, kMaxBuckets = 1 << 12;
    std::size_t n = 0;
    for (const BigVector<T>& chunk : chunks) n += chunk.size();
    const std::size_t count = std::clamp<std::size_t>(n / kBucket, 1, kMaxBuckets);
    const Buckets buckets = buckets_of(chunks, n, count, key);
    std::vector<std::size_t> first(count + 1, 0);
    BigVector<T> sorted = scatter(threads, chunks, [&](const T& item) { return buckets.of(key(item)); }, first);
    allocate(n);
    const std::size_t max = is_scratch(sorted.data()) ? sortable_items<T>(threads) : n;
    const auto bucket_of = [&](std::size_t b) { return std::span(sorted).subspan(first[b], first[b + 1] - first[b]); };
    for_each_block(threads, static_cast<std::int64_t>(count), [&](std::int64_t b) {
        std::span<T> bucket = bucket_of(b);
        if (bucket.size() > max) return;
        std::vector<T> buffer;
        if (is_scratch(bucket.data())) {
            (void)part_in_memory<T>(bucket, buffer);
            bucket = buffer;
        }
        sort_by_steps(bucket, key, before);
        put(first[b], std::span<const T>(bucket));
    });
    for (std::size_t b = 0; b < count; ++b) {
        if (bucket_of(b).size() <= max) continue;
        sort_large(threads, bucket_of(b), max, key, before,
                   [&](std::size_t from, std::span<const T> items) { put(first[b] + from, items); });
    }
}

}  // namespace isoatlas
