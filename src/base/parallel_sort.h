// Sorting on several threads: samples cut the values into buckets, buckets are sorted on their own, small enough for the cache.
// The order must be strict and total: then the result does not depend on threads nor buckets.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/big_vector.h"
#include "base/parallel.h"

namespace isoatlas {

/// Sorts items by before(p, q), where before must agree with key (a double): key(p) < key(q) implies before(p, q). Uses a second array.
template <class T, class Key, class Before>
void bucket_sort(int threads, BigVector<T>& items, const Key& key, const Before& before) {
    constexpr std::size_t kSmall = 1 << 14, kBucket = 1 << 10, kBlocks = 64;
    const std::size_t n = items.size();
    if (n < kSmall) {
        std::sort(items.begin(), items.end(), before);
        return;
    }
    const std::size_t buckets = std::min<std::size_t>(n / kBucket, 1 << 12);
    std::vector<decltype(key(items[0]))> splitters;  // bucket b holds the keys in (splitter[b-1], splitter[b]]
    {
        std::vector<decltype(key(items[0]))> samples;
        const std::size_t stride = std::max<std::size_t>(1, n / (16 * buckets));
        for (std::size_t i = 0; i < n; i += stride) samples.push_back(key(items[i]));
        std::sort(samples.begin(), samples.end());
        for (std::size_t b = 1; b < buckets; ++b) splitters.push_back(samples[b * samples.size() / buckets]);
    }
    // Equal steps over the keys narrow the search down to the splitters within a step.
    const double low = splitters.front(), width = splitters.back() - low;
    const double steps = static_cast<double>(4 * buckets), factor = width > 0 && steps / width < 1e300 ? steps / width : 0;
    const auto step_of = [&](double k) { return static_cast<std::size_t>(std::clamp((k - low) * factor, 0.0, steps)); };
    std::vector<std::uint16_t> first_of_step(4 * buckets + 2, 0);
    for (const double splitter : splitters) ++first_of_step[step_of(splitter) + 1];
    for (std::size_t s = 1; s < first_of_step.size(); ++s) first_of_step[s] = static_cast<std::uint16_t>(first_of_step[s] + first_of_step[s - 1]);
    const auto bucket_of = [&](const T& item) {
        const double k = key(item);
        const std::size_t step = step_of(k);
        const auto begin = splitters.begin() + first_of_step[step], end = splitters.begin() + first_of_step[step + 1];
        return static_cast<std::uint16_t>(std::lower_bound(begin, end, k) - splitters.begin());
    };
    // Count per block and bucket, turn counts into places, scatter, sort every bucket.
    const auto block_range = [&](std::size_t block) { return std::array{n * block / kBlocks, n * (block + 1) / kBlocks}; };
    std::vector<std::size_t> place(kBlocks * buckets, 0);
    BigVector<std::uint16_t> bucket(n);
    for_each_block(threads, kBlocks, [&](std::int64_t block) {
        const auto [begin, end] = block_range(block);
        for (std::size_t i = begin; i < end; ++i) ++place[block * buckets + (bucket[i] = bucket_of(items[i]))];
    });
    std::vector<std::size_t> first(buckets + 1, 0);
    std::size_t next = 0;
    for (std::size_t b = 0; b < buckets; ++b) {
        first[b] = next;
        for (std::size_t block = 0; block < kBlocks; ++block) {
            const std::size_t count = place[block * buckets + b];
            place[block * buckets + b] = next;
            next += count;
        }
    }
    first[buckets] = n;
    BigVector<T> sorted(n);
    for_each_block(threads, kBlocks, [&](std::int64_t block) {
        const auto [begin, end] = block_range(block);
        for (std::size_t i = begin; i < end; ++i) sorted[place[block * buckets + bucket[i]]++] = items[i];
    });
    release(items);
    for_each_block(threads, static_cast<std::int64_t>(buckets),
                   [&](std::int64_t b) { std::sort(sorted.begin() + first[b], sorted.begin() + first[b + 1], before); });
    items.swap(sorted);
}

}  // namespace isoatlas
