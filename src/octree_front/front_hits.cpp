#include "octree_front/front_hits.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "base/check.h"

namespace isoatlas {
namespace {

/// Positions as bits, line by line, and which words have some, one bit each for words 64 apart. All zeros between its uses.
struct Marks {
    std::vector<std::uint64_t> bits, words;
    void fit(std::size_t lines, std::size_t words_of_line) {
        if (bits.size() < lines * words_of_line) bits.resize(lines * words_of_line);
        if (words.size() < lines) words.resize(lines);
    }
};

}  // namespace

FrontHits::FrontHits(const FrontLeaves& leaves)
    : shift_(leaves.blocks().max_level()),
      rows_y_(leaves.blocks().blocks(shift_)[1]),
      words_((leaves.blocks().blocks(0)[0] + 64) / 64),
      rows_(static_cast<std::size_t>(leaves.rows())) {}

void FrontHits::keep(std::int64_t row, std::span<const EdgeHit> hits) {
    const std::size_t lines = std::size_t{3} << 2 * shift_, words_of_line = static_cast<std::size_t>(words_);
    thread_local Marks marks;
    marks.fit(lines, words_of_line);
    for (const EdgeHit& hit : hits) {
        if (owner_of(hit) != row) continue;
        const std::size_t line = line_of(hit), word = static_cast<std::size_t>(hit.position[0] / 64);
        marks.bits[line * words_of_line + word] |= std::uint64_t{1} << hit.position[0] % 64;
        marks.words[line] |= std::uint64_t{1} << word % 64;
    }
    Row& found = rows_[static_cast<std::size_t>(row)];
    found.begin.resize(lines + 1);
    for (std::size_t line = 0; line < lines; ++line) {
        found.begin[line] = found.position.size();
        for (std::uint64_t pending = std::exchange(marks.words[line], 0); pending != 0; pending &= pending - 1) {
            for (auto word = static_cast<std::size_t>(std::countr_zero(pending)); word < words_of_line; word += 64) {
                for (std::uint64_t bits = std::exchange(marks.bits[line * words_of_line + word], 0); bits != 0; bits &= bits - 1)
                    found.position.push_back(static_cast<std::int32_t>(64 * static_cast<std::int64_t>(word) + std::countr_zero(bits)));
            }
        }
        if (words_of_line > 64) std::sort(found.position.begin() + static_cast<std::ptrdiff_t>(found.begin[line]), found.position.end());
    }
    found.begin[lines] = found.position.size();
}

std::int64_t FrontHits::number() {
    std::int64_t points = 0;
    for (Row& row : rows_) points += std::ssize(row.position), row.point = points - std::ssize(row.position);
    return points;
}

std::int64_t FrontHits::point_of(const EdgeHit& hit) const {
    const Row& row = rows_[static_cast<std::size_t>(owner_of(hit))];
    const std::size_t line = line_of(hit);
    const auto first = row.position.begin();
    const auto begin = first + static_cast<std::ptrdiff_t>(row.begin[line]), end = first + static_cast<std::ptrdiff_t>(row.begin[line + 1]);
    const auto found = std::lower_bound(begin, end, hit.position[0]);
    ISOATLAS_CHECK(found != end && *found == hit.position[0]);
    return row.point + (found - first);
}

}  // namespace isoatlas
