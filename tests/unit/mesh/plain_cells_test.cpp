// Vectors count and write what the plain loops do, and call for the same other cells; hits of a word are appended alike.
#include "mesh/plain_cells.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "mesh/hit_batch.h"
#include "mesh/vector_cells.h"

namespace isoatlas {
namespace {

#if ISOATLAS_HAS_AVX512

/// Samples of rows that lie around one row of cells: mostly like the one before them.
HighBits arbitrary_bits(std::int64_t length) {
    Extent extent;
    extent.size = {length, 2, 2};
    HighBits high(extent);
    const int change = *rc::gen::inRange(1, 20);
    for (std::int64_t z = 0; z < 2; ++z) {
        for (std::int64_t y = 0; y < 2; ++y) {
            const auto flips = *rc::gen::container<std::vector<int>>(static_cast<std::size_t>(length), rc::gen::inRange(0, change));
            bool is_high = false;
            for (std::int64_t x = 0; x < length; ++x) {
                is_high ^= flips[static_cast<std::size_t>(x)] == 0;
                if (is_high) high.row(y, z)[(x + 1) / 64] |= std::uint64_t{1} << (x + 1) % 64;
            }
        }
    }
    return high;
}

using Triangles = std::vector<std::array<std::int64_t, 3>>;
using Calls = std::vector<std::vector<std::int64_t>>;

/// Calls check(count, write) for the kinds of vectors that the processor has.
template <class Check>
void for_vectors(const Check& check) {
    if (kHasAvx512) check([](auto&&... of) { count_avx512(of...); }, [](auto&&... of) { write_avx512(of...); });
    if (kHasFused)
        check([](auto&&... of) { count_avx2(of...); },
              [](const auto& rows, const auto& window, const auto& cells, const auto& first, auto* begin, auto* /*end*/, const auto& rest) {
                  write_avx2(rows, window, cells, first, begin, rest);
              });
}

RC_GTEST_PROP(PlainCells, AreTheSameWithVectors, ()) {
    const std::int64_t length = *rc::gen::inRange<std::int64_t>(2, 300);
    const HighBits high = arbitrary_bits(length);
    const bool tunnels = *rc::gen::arbitrary<bool>(), flip = *rc::gen::arbitrary<bool>(), closed = *rc::gen::arbitrary<bool>();
    const PlainCells cells(*rc::gen::element(SurfaceStyle::compact, SurfaceStyle::full), tunnels, flip);
    const CellWindow window = closed ? CellWindow::all(length) : CellWindow::real(length);
    const CellRow<4> rows = cell_row(high, 0, 0);

    RowOffsets plain{};
    Calls plain_calls;
    count_plain(rows, window, cells, plain, [&](std::int64_t p, int pattern) { plain_calls.push_back({p, pattern}); });

    const HitCounters first{0, 1000, 2000, 3000, 4000, 5000, 6000, 7000};
    const auto written = [&](const auto& write) {
        // Each of the other cells takes one place; nothing behind the end may be touched.
        Triangles triangles(static_cast<std::size_t>(plain.triangle) + plain_calls.size() + 8, {-1, -1, -1});
        Calls calls;
        write(
            triangles.data(), triangles.data() + plain.triangle + static_cast<std::int64_t>(plain_calls.size()),
            [&](std::int64_t p, int pattern, const HitCounters& before, const HitCounters& after, std::array<std::int64_t, 3>*& triangle) {
                calls.push_back({p, pattern});
                calls.back().insert(calls.back().end(), before.begin(), before.end());
                calls.back().insert(calls.back().end(), after.begin(), after.end());
                *triangle++ = {p, p, p};
            });
        return std::pair(triangles, calls);
    };
    const auto with_loops =
        written([&](auto* begin, auto* end, const auto& rest) { write_plain(rows, window, cells, first, begin, end, rest); });
    for_vectors([&](const auto& count, const auto& write) {
        RowOffsets place{};
        Calls calls;
        count(rows, window, cells, place, [&](std::int64_t p, int pattern) { calls.push_back({p, pattern}); });
        RC_ASSERT(std::tie(plain.triangle, plain.x_hits, plain.y_hits, plain.z_hits, plain.hit_words, plain.cell_words) ==
                  std::tie(place.triangle, place.x_hits, place.y_hits, place.z_hits, place.hit_words, place.cell_words));
        RC_ASSERT(plain_calls == calls);
        const auto with_vectors =
            written([&](auto* begin, auto* end, const auto& rest) { write(rows, window, cells, first, begin, end, rest); });
        RC_ASSERT(with_loops.first == with_vectors.first);
        RC_ASSERT(with_loops.second == with_vectors.second);
    });
    RC_ASSERT(with_loops.first.back() == (std::array<std::int64_t, 3>{-1, -1, -1}));
}

// Rows that are all the same but for one of them, from one place on: wherever words meet.
TEST(PlainCells, AreCountedWhereOneRowChanges) {
    const PlainCells cells(SurfaceStyle::compact, false, false);
    const auto counted = [&](const HighBits& high, const auto& count) {
        RowOffsets place{};
        std::int64_t others = 0;
        count(cell_row(high, 0, 0), CellWindow::all(high.extent().size[0]), cells, place, [&](std::int64_t, int) { ++others; });
        return std::array<std::uint64_t, 7>{
            static_cast<std::uint64_t>(place.triangle), place.x_hits, place.y_hits, place.z_hits, place.hit_words, place.cell_words,
            static_cast<std::uint64_t>(others)};
    };
    for (const std::int64_t length : {62, 63, 64, 65, 127, 200}) {
        for (std::int64_t from = 0; from < length; ++from) {
            for (std::int64_t changed = 0; changed < 8; ++changed) {
                HighBits high(Extent{3, {length, 2, 2}});
                for (std::int64_t row = 0; row < 4; ++row) {
                    for (std::int64_t x = 0; x < length; ++x) {
                        const bool is_high = (changed >= 4) != (row == changed % 4 && x >= from);
                        high.row(row % 2, row / 2)[(x + 1) / 64] |= std::uint64_t{is_high} << (x + 1) % 64;
                    }
                }
                const auto expected = counted(high, [](auto&&... of) { count_plain(of...); });
                for_vectors([&](const auto& count, const auto&) {
                    EXPECT_EQ(expected, counted(high, count)) << "row " << changed << " of " << length << " from " << from;
                });
            }
        }
    }
}

RC_GTEST_PROP(HitBatch, IsTheSameWithWideVectors, ()) {
    if (!kHasAvx512) return;
    HitBatch plain, wide;
    const auto words = *rc::gen::container<std::vector<std::uint64_t>>(rc::gen::arbitrary<std::uint64_t>());
    std::int64_t point = 0;
    for (const std::uint64_t bits : words) {
        if (plain.is_full()) break;
        const HitRun run{*rc::gen::inRange(-1, 5000), *rc::gen::inRange(0, 8), *rc::gen::inRange(0, 32), point};
        const std::int64_t count = append_plain(run, bits, plain);
        RC_ASSERT(append_avx512(run, bits, wide) == count);
        RC_ASSERT(count == std::popcount(bits));
        point += count;
    }
    RC_ASSERT(plain.count == wide.count);
    for (std::size_t i = 0; i < plain.count; ++i) {
        for (std::size_t k = 0; k < 3; ++k) RC_ASSERT(plain.from[k][i] == wide.from[k][i]);
        RC_ASSERT(plain.point[i] == wide.point[i]);
    }
}

#endif

// The counters of a cell and of the next one are all of its hits.
TEST(PlainCells, FarEdgesAreTheNearOnesOfTheNextCell) {
    const HitCounters before{10, 20, 30, 40, 50, 60, 70, 80}, after{11, 21, 31, 41, 51, 61, 71, 81};
    EXPECT_EQ(points_of(before, after), (std::array<std::int64_t, 12>{10, 20, 30, 40, 50, 51, 60, 61, 70, 71, 80, 81}));
}

}  // namespace
}  // namespace isoatlas
