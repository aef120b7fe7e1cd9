// The corner structure of a node: its short multi lists together, so that a query does not read a block for each.
//
// A short list [p, q] is active in the slabs p to q. Consecutive slabs make a window, which has one list of all entries active in any of
// them, as long as no slab of it would read more than twice its own active entries and a block:
//   list of the window <= 2 (active in the slab) + (entries of a block), for each of its slabs.
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

struct CornerWindow {
    int first, last;       ///< slabs
    std::int64_t entries;  ///< of its list
};

/// count(p, q): entries of a short list, 0 of others, 1 <= p <= q <= slabs - 2. Windows in order, of all those slabs. Cost: slabs^3.
template <class Count>
[[nodiscard]] std::vector<CornerWindow> corner_windows(int slabs, std::int64_t entries_of_block, const Count& count) {
    const int last = slabs - 2;
    std::vector<std::int64_t> begins(static_cast<std::size_t>(slabs), 0), active(static_cast<std::size_t>(slabs), 0);
    for (int p = 1; p <= last; ++p) {
        for (int q = p; q <= last; ++q) {
            begins[static_cast<std::size_t>(p)] += count(p, q);
            for (int slab = p; slab <= q; ++slab) active[static_cast<std::size_t>(slab)] += count(p, q);
        }
    }
    std::vector<CornerWindow> windows;
    std::int64_t fewest = 0;
    for (int slab = 1; slab <= last; ++slab) {
        const std::int64_t here = active[static_cast<std::size_t>(slab)], more = begins[static_cast<std::size_t>(slab)];
        if (!windows.empty() && windows.back().entries + more <= 2 * std::min(fewest, here) + entries_of_block) {
            windows.back() = {windows.back().first, slab, windows.back().entries + more};
            fewest = std::min(fewest, here);
        } else {
            windows.push_back({slab, slab, here});
            fewest = here;
        }
    }
    return windows;
}

}  // namespace isoatlas
