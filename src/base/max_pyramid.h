// MaxPyramid: finds all entries of a long array that reach a limit, by the maxima (minima) of every 16 entries, of every 16 of these, ...
//
// Stabbing queries of intervals [i, end(i)), one for each i: those that contain r are the entries of [0, r) that reach r. So the array of
// the ends replaces an interval tree, and the pyramid adds a fifteenth of it.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace isoatlas {

/// Compare: std::greater for maxima, std::less for minima. The entries must live as long as this.
template <class T, class Compare>
class MaxPyramid {
public:
    /// Cost: O(entries).
    explicit MaxPyramid(std::span<const T> entries) : entries_(entries) {
        std::span<const T> below = entries;
        while (below.size() > 1) {
            std::vector<T> level((below.size() + kGroup - 1) / kGroup);
            for (std::size_t i = 0; i < below.size(); ++i) {
                T& extreme = level[i / kGroup];
                if (i % kGroup == 0 || Compare()(below[i], extreme)) extreme = below[i];
            }
            levels_.push_back(std::move(level));
            below = levels_.back();
        }
    }

    /// Calls visit(i), i ascending, for the i in [begin, end) whose entry reaches the limit.
    /// Cost: O((1 + visits) log entries).
    template <class Visit>
    void for_each_at_least(std::size_t begin, std::size_t end, T limit, Visit&& visit) const {
        const auto reaches = [limit](const T& entry) { return !Compare()(limit, entry); };
        for (std::size_t i = begin; i < end;) {
            const std::size_t step = empty_group(i, reaches);
            if (step == 0 && reaches(entries_[i])) visit(i);
            i += step == 0 ? 1 : step;
        }
    }

private:
    static constexpr std::size_t kGroup = 16;

    /// Size of the largest group that begins at i and has no entry that reaches the limit; 0: there is none.
    template <class Reaches>
    [[nodiscard]] std::size_t empty_group(std::size_t i, const Reaches& reaches) const {
        std::size_t size = 1, empty = 0;
        for (const std::vector<T>& level : levels_) {
            if (i % (size * kGroup) != 0) break;
            size *= kGroup;
            if (reaches(level[i / size])) break;
            empty = size;
        }
        return empty;
    }

    std::span<const T> entries_;
    std::vector<std::vector<T>> levels_;
};

}  // namespace isoatlas
