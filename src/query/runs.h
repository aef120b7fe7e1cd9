// Runs: the maximal stretches of one class in every row. The vertices of the graph whose components are the objects.
//
// Row r = y + ny * z. Its runs alternate Low, High, Low, ..., Low: the first and the last contain the padding, so a run with an odd number
// inside its row is High. Run i of row r has the number first_change[r] + r + i and the positions [change(i - 1), change(i)) of the row's
// bits (position p is voxel x = p - 1).
// Memory: 8 bytes a row and 4 bytes a change.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "isoatlas/context.h"
#include "query/high_bits.h"

namespace isoatlas {

struct RunRow {
    const std::uint32_t* change;  ///< positions where the class changes, ascending
    std::int64_t changes;
    std::int64_t first_run;  ///< number of the run before the first change

    [[nodiscard]] std::int64_t runs() const { return changes + 1; }
    /// Which run of the row contains a position.
    [[nodiscard]] std::int64_t run_at(std::int64_t position) const {
        return first_run + (std::upper_bound(change, change + changes, position) - change);
    }
};

struct Runs {
    Extent extent;
    std::vector<std::int64_t> first_change;  ///< per row, and the total at the end
    std::vector<std::uint32_t> change;

    [[nodiscard]] std::int64_t rows() const { return extent.size[1] * extent.size[2]; }
    [[nodiscard]] std::int64_t count() const { return first_change.back() + rows(); }
    [[nodiscard]] RunRow row(std::int64_t r) const {
        return {change.data() + first_change[r], first_change[r + 1] - first_change[r], first_change[r] + r};
    }
    [[nodiscard]] RunRow row(std::int64_t y, std::int64_t z) const { return row(y + extent.size[1] * z); }
};

/// The runs of the rows. Throws Error{unsupported} for rows of 2^32 voxels or more.
[[nodiscard]] Runs find_runs(const HighBits& high, const Context& context);

}  // namespace isoatlas
