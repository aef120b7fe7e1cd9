// Sorting by keys that are spread more or less evenly.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace isoatlas {

/// Sorts items by before(p, q), which agrees with key: equal steps over the keys nearly sort them, insertion does the rest.
/// Cost: O(n) when keys are spread evenly, O(n log n) at worst.
template <class T, class Key, class Before>
void sort_by_steps(std::span<T> items, const Key& key, const Before& before) {
    constexpr std::size_t kFew = 32, kCrowd = 16;
    const std::size_t n = items.size();
    double low = 0, factor = 0;
    if (n > kFew) {
        const auto [min, max] = std::minmax_element(items.begin(), items.end(), [&](const T& p, const T& q) { return key(p) < key(q); });
        low = key(*min);
        factor = static_cast<double>(n - 1) / (key(*max) - low);
    }
    if (!(factor > 0 && factor < 1e300)) return std::sort(items.begin(), items.end(), before);
    const auto step_of = [&](const T& item) { return std::min(n - 1, static_cast<std::size_t>((key(item) - low) * factor)); };
    const std::vector<T> unsorted(items.begin(), items.end());
    std::vector<std::size_t> end(n, 0);  // of every step; first its number of items, then where its next item goes
    for (const T& item : unsorted) ++end[step_of(item)];
    std::size_t next = 0;
    for (std::size_t& step : end) next += std::exchange(step, next);
    for (const T& item : unsorted) items[end[step_of(item)]++] = item;
    for (std::size_t step = 0, first = 0; step < n; first = end[step++]) {
        if (end[step] - first > kCrowd) std::sort(items.begin() + first, items.begin() + end[step], before);
    }
    for (std::size_t i = 1; i < n; ++i) {
        const T item = items[i];
        std::size_t place = i;
        for (; place > 0 && before(item, items[place - 1]); --place) items[place] = items[place - 1];
        items[place] = item;
    }
}

}  // namespace isoatlas
