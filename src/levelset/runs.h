// Runs: the maximal stretches of one class in every row. The vertices of the graph whose components are the objects.
//
// Row r = y + ny * z. Its runs alternate Low, High, Low, ..., Low: the first and the last contain the padding. Run i of row r has the
// number first_change[r] + i and the positions [change(i - 1), change(i)) of the row's bits (position p is voxel x = p - 1). Odd numbers
// are High. The last run of a row and the first of the next have one number: both lie in the outside. Rows without changes have no run of
// their own. Memory: 8 bytes a row and 4 bytes a change.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "isoatlas/context.h"
#include "isoatlas/id.h"
#include "levelset/high_bits.h"

namespace isoatlas {

using RunId = StrongId<struct RunTag, std::int64_t>;

struct RunRow {
    const std::uint32_t* change;  ///< positions where the class changes, ascending
    std::int64_t changes;
    RunId first_run;  ///< the run before the first change

    /// Which run of the row contains a position: 0 to `changes`.
    [[nodiscard]] std::int64_t index_at(std::int64_t position) const {
        return std::upper_bound(change, change + changes, position) - change;
    }
    [[nodiscard]] RunId run_at(std::int64_t position) const { return run(index_at(position)); }
    /// Run i of the row.
    [[nodiscard]] RunId run(std::int64_t i) const { return RunId(first_run.number() + i); }
    [[nodiscard]] bool is_high(RunId run) const { return ((run.number() - first_run.number()) & 1) != 0; }
    /// Does run i of the row contain padding?
    [[nodiscard]] bool is_outside(std::int64_t i) const { return i == 0 || i == changes; }
};

struct Runs {
    Extent extent;
    std::vector<std::int64_t> first_change;  ///< per row, and the total at the end
    std::vector<std::uint32_t> change;

    [[nodiscard]] std::int64_t rows() const { return extent.size[1] * extent.size[2]; }
    [[nodiscard]] std::int64_t count() const { return first_change.back() + 1; }
    [[nodiscard]] RunRow row(std::int64_t r) const {
        return {change.data() + first_change[r], first_change[r + 1] - first_change[r], RunId(first_change[r])};
    }
    [[nodiscard]] RunRow row(std::int64_t y, std::int64_t z) const { return row(y + extent.size[1] * z); }
};

/// The runs of the rows. Throws Error{unsupported} for rows of 2^32 voxels or more.
[[nodiscard]] Runs find_runs(const HighBits& high, const Context& context);

}  // namespace isoatlas
