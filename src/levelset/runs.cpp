#include "levelset/runs.h"

#include <bit>
#include <limits>

#include "field/slab_work.h"

namespace isoatlas {
namespace {

std::uint64_t changes_of(const std::uint64_t* row, std::int64_t w) { return row[w] ^ bits_before(row, w); }

std::int64_t count_changes(const std::uint64_t* row, const WordSet& candidates) {
    std::int64_t count = 0;
    candidates.for_each([&](std::int64_t w) { count += std::popcount(changes_of(row, w)); });
    return count;
}

void list_changes(const std::uint64_t* row, const WordSet& candidates, std::uint32_t* out) {
    candidates.for_each([&](std::int64_t w) {
        for (std::uint64_t rest = changes_of(row, w); rest != 0; rest &= rest - 1) {
            *out++ = static_cast<std::uint32_t>(64 * w + std::countr_zero(rest));
        }
    });
}

}  // namespace

Runs find_runs(const HighBits& high, const Context& context) {
    const Extent& extent = high.extent();
    if (extent.size[0] >= std::numeric_limits<std::uint32_t>::max() - 1) {
        throw Error(ErrorKind::unsupported, {.what = "the first axis has 2^32 or more voxels", .next = "reorder the axes of the volume"});
    }
    Runs runs{extent, std::vector<std::int64_t>(static_cast<std::size_t>(extent.size[1] * extent.size[2] + 1)), {}};
    const std::int64_t ny = extent.size[1];
    const auto for_rows = [&](auto&& visit) {
        for_each_row(context, kCutPhases["objects"], extent,
                     [&](std::int64_t y, std::int64_t z) { visit(y + ny * z, high.row(y, z), high.candidates(y, z)); });
    };
    for_rows([&](std::int64_t r, const std::uint64_t* row, const WordSet& candidates) {
        runs.first_change[r + 1] = count_changes(row, candidates);
    });
    for (std::int64_t r = 0; r < runs.rows(); ++r) runs.first_change[r + 1] += runs.first_change[r];
    runs.change.resize(static_cast<std::size_t>(runs.first_change.back()));
    for_rows([&](std::int64_t r, const std::uint64_t* row, const WordSet& candidates) {
        list_changes(row, candidates, runs.change.data() + runs.first_change[r]);
    });
    return runs;
}

}  // namespace isoatlas
