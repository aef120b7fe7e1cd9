// Counts the intervals that contain an isovalue, for a sorted list of isovalues.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

namespace isoatlas {

class IntervalCounts {
public:
    /// isovalues: ascending; they must outlive this.
    explicit IntervalCounts(std::span<const double> isovalues) : isovalues_(isovalues), change_(isovalues.size() + 1, 0) {}

    /// Counts (low, high] `times` times; no effect when it is empty. From any thread. Cost: O(log isovalues).
    void add(double low, double high, std::int64_t times = 1) {
        if (!(low < high)) return;
        const auto first = std::ranges::upper_bound(isovalues_, low), last = std::upper_bound(first, isovalues_.end(), high);
        if (first == last) return;
        at(first).fetch_add(times, std::memory_order_relaxed);
        at(last).fetch_sub(times, std::memory_order_relaxed);
    }
    /// Per isovalue.
    [[nodiscard]] std::vector<std::int64_t> counts() const {
        std::vector<std::int64_t> result(isovalues_.size());
        std::int64_t sum = 0;
        for (std::size_t i = 0; i < result.size(); ++i) result[i] = sum += change_[i];
        return result;
    }

private:
    [[nodiscard]] std::atomic_ref<std::int64_t> at(std::span<const double>::iterator place) {
        return std::atomic_ref(change_[static_cast<std::size_t>(place - isovalues_.begin())]);
    }

    std::span<const double> isovalues_;
    std::vector<std::int64_t> change_;
};

}  // namespace isoatlas
