// The corner structure of a node: its short multi lists together, so that a query does not read a block for each.
//
// A short list [p, q] is active in the slabs p to q. Consecutive slabs make a window, which has one list of all entries active in any of
// them, as long as no slab of it would read more than twice its own active entries and a block:
//   list of the window <= 2 (active in the slab) + (entries of a block), for each of its slabs.
// In the list come first entries that begin before the window, by their last slab, then those that begin in it, by their first slab. So a
// slab reads a part of it without interruption, which leaves out what ended before it or begins after it; what it reads in vain both begins
// and ends in the window.
//
// Why all lists together are short: of a window [a, i) that could not take slab i, let j be the slab of a .. i with the fewest active
// entries. More than half of those of [a, i] are not active in j: they end in [a, j) or begin in (j, i]. Ends in [a, i), and begins in
// (a, i], are counted for one window only: so all windows but the last have less than 4, all together less than 5 times the entries.
//
// In the literature: the corner structure of Kanellakis, Ramaswamy, Vengroff, Vitter (Indexing for data models with constraints and
// classes, 1996), which Arge and Vitter use; with as few queries as a node has slabs it is the window list of Chazelle (Filtering search,
// 1986).
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace isoatlas {

class CornerStructure {
public:
    struct Window {
        int first, last;  ///< slabs
        std::int64_t entries;
        std::size_t part;  ///< the first one of its list
        [[nodiscard]] int more() const { return last - first; }
    };

    /// count(p, q): entries of a short list, 0 of others, 1 <= p <= q <= slabs - 2. Cost: slabs^3.
    template <class Count>
    CornerStructure(int slabs, std::int64_t entries_of_block, const Count& count) : window_of_(static_cast<std::size_t>(slabs), 0) {
        cut(slabs - 2, entries_of_block, count);
        for (Window& window : windows_) {
            window.part = sizes_.size();
            sizes_.resize(sizes_.size() + static_cast<std::size_t>(2 * window.more() + 1), 0);
            for (int slab = window.first; slab <= window.last; ++slab)
                window_of_[static_cast<std::size_t>(slab)] = static_cast<std::size_t>(&window - windows_.data());
        }
        for (int p = 1; p <= slabs - 2; ++p) {
            for (int q = p; q <= slabs - 2; ++q) for_parts(p, q, [&](std::size_t part) { sizes_[part] += count(p, q); });
        }
    }

    /// Of all slabs from 1 on, in order.
    [[nodiscard]] const std::vector<Window>& windows() const { return windows_; }
    /// Entries of the parts of all lists, which lie one after the other.
    [[nodiscard]] const std::vector<std::int64_t>& sizes() const { return sizes_; }
    /// The parts that a slab reads: from the first one to the last.
    [[nodiscard]] std::size_t first_part(int slab) const {
        const Window& window = of(slab);
        return window.part + static_cast<std::size_t>(slab - window.first);
    }
    [[nodiscard]] std::size_t last_part(int slab) const { return first_part(slab) + static_cast<std::size_t>(of(slab).more()); }

    /// Calls visit(part) for the part of each window that has the entries of list [p, q].
    template <class Visit>
    void for_parts(int p, int q, const Visit& visit) const {
        const std::size_t last = window_of_[static_cast<std::size_t>(q)];
        for (std::size_t w = window_of_[static_cast<std::size_t>(p)]; w <= last; ++w) {
            const Window& window = windows_[w];
            const int part = p <= window.first ? std::min(q, window.last) - window.first : window.more() + p - window.first;
            visit(window.part + static_cast<std::size_t>(part));
        }
    }

private:
    [[nodiscard]] const Window& of(int slab) const { return windows_[window_of_[static_cast<std::size_t>(slab)]]; }

    template <class Count>
    void cut(int last, std::int64_t entries_of_block, const Count& count) {
        std::vector<std::int64_t> begins(window_of_.size(), 0), active(window_of_.size(), 0);
        for (int p = 1; p <= last; ++p) {
            for (int q = p; q <= last; ++q) {
                begins[static_cast<std::size_t>(p)] += count(p, q);
                for (int slab = p; slab <= q; ++slab) active[static_cast<std::size_t>(slab)] += count(p, q);
            }
        }
        std::int64_t fewest = 0;
        for (int slab = 1; slab <= last; ++slab) {
            const std::int64_t here = active[static_cast<std::size_t>(slab)], more = begins[static_cast<std::size_t>(slab)];
            if (!windows_.empty() && windows_.back().entries + more <= 2 * std::min(fewest, here) + entries_of_block) {
                windows_.back().last = slab;
                windows_.back().entries += more;
                fewest = std::min(fewest, here);
            } else {
                windows_.push_back({slab, slab, here, 0});
                fewest = here;
            }
        }
    }

    std::vector<Window> windows_;
    std::vector<std::size_t> window_of_;  ///< a slab
    std::vector<std::int64_t> sizes_;
};

}  // namespace isoatlas
