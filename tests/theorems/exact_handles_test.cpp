// Exact handles are the persistence pairs of the first homology.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "isoatlas/error.h"
#include "isoatlas/handles.h"
#include "isoatlas/phantom.h"
#include "oracle/bodies.h"
#include "oracle/difference.h"
#include "oracle/finer.h"
#include "oracle/homology.h"
#include "oracle/mesh_checks.h"

namespace oracle {
namespace {

using isoatlas::Analysis;
using isoatlas::Handle;
using isoatlas::Interpolant;
using isoatlas::Volume;

std::vector<HolePair> pairs_of(const std::vector<Handle>& handles) {
    std::vector<HolePair> pairs;
    for (const Handle& handle : handles) pairs.push_back({handle.opens, handle.closes});
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

std::vector<HolePair> exact_pairs(const Grid& grid, Interpolant interpolant) {
    const Volume volume = to_volume(grid);
    return pairs_of(isoatlas::pair_handles_exactly(volume, isoatlas::analyse(volume, {.interpolant = interpolant})));
}

std::string text(const std::vector<HolePair>& pairs) {
    std::ostringstream out;
    out.precision(17);
    for (const HolePair& pair : pairs) out << pair.opens << ".." << pair.closes << ' ';
    return out.str();
}

void exact_handles_equal_the_homology_of_a_whole_complex() {
    const Grid grid = *arbitrary_grid(6, 100);
    const std::vector<HolePair> expected = grid.rank == 2 ? std::vector<HolePair>() : hole_pairs(Elements(grid));
    RC_ASSERT(text(exact_pairs(grid, Interpolant::faces)) == text(expected));
}

Grid noise(std::mt19937& random, const std::array<Index, 3>& size, int values) {
    Grid grid{3, size, {}};
    std::uniform_real_distribution<double> uniform(0, values);
    for (Index v = 0; v < grid.voxels(); ++v) grid.value.push_back(values == 1 ? uniform(random) : std::floor(uniform(random)));
    return grid;
}

// Noise has many holes, and the last one opened is often not the first one closed.
TEST(ExactHandles, OfNoiseEqualTheHomologyOfAWholeComplex) {
    std::mt19937 random(3);
    Index pairs = 0, approximate_differ = 0;
    for (int i = 0; i < 60; ++i) {
        const Grid grid = noise(random, {5, 4 + i % 3, 5}, i % 3 == 0 ? 1 : 2 + i % 7);
        const std::vector<HolePair> expected = hole_pairs(Elements(grid));
        ASSERT_EQ(text(exact_pairs(grid, Interpolant::faces)), text(expected)) << i;
        pairs += static_cast<Index>(expected.size());
        const Analysis analysis = isoatlas::analyse(to_volume(grid), {.interpolant = Interpolant::faces});
        approximate_differ += pairs_of(isoatlas::pair_handles(analysis)) != expected;
    }
    EXPECT_GT(pairs, 300);
    EXPECT_GT(approximate_differ, 10);
}

double total(const std::vector<Handle>& handles) {
    double sum = 0;
    for (const Handle& handle : handles) sum += handle.persistence();
    return sum;
}

void exact_handles_open_and_close_where_the_approximate_ones_do() {
    const Grid grid = *arbitrary_grid(7, 150);
    const Volume volume = to_volume(grid);
    const Analysis analysis = isoatlas::analyse(volume, {.interpolant = *arbitrary_interpolant()});
    const std::vector<Handle> exact = isoatlas::pair_handles_exactly(volume, analysis), quick = isoatlas::pair_handles(analysis);
    RC_ASSERT(std::abs(total(exact) - total(quick)) <= 1e-9 * (1 + std::abs(total(quick))));
    for (const double tau : interesting_values(elements_of(grid, analysis.interpolant()))) {
        const auto open = [&](const std::vector<Handle>& handles) {
            return std::ranges::count_if(handles, [&](const Handle& h) { return h.closes < tau && tau <= h.opens; });
        };
        RC_ASSERT(open(exact) == open(quick));
    }
    for (std::size_t i = 1; i < exact.size(); ++i) RC_ASSERT(exact[i - 1].persistence() >= exact[i].persistence());
}

void handles_do_not_depend_on_how_the_volume_lies() {
    const Grid grid = *arbitrary_grid(4, 50);
    const Interpolant interpolant = *arbitrary_interpolant();
    const std::string expected = text(exact_pairs(grid, interpolant));
    for (const auto& [order, mirror] : turns(grid.rank))
        RC_ASSERT(text(exact_pairs(rotated(grid, order, mirror), interpolant)) == expected);
}

/// Pairs of one list that the other lacks; those of nearly no persistence do not count.
Index missing(const std::vector<HolePair>& some, std::vector<HolePair> others, double tolerance) {
    Index missing = 0;
    for (const HolePair& pair : some) {
        if (pair.opens - pair.closes < 4 * tolerance) continue;
        const auto same = std::ranges::find_if(others, [&](const HolePair& other) {
            return std::abs(other.opens - pair.opens) < tolerance && std::abs(other.closes - pair.closes) < tolerance;
        });
        if (same == others.end()) {
            ++missing;
        } else {
            others.erase(same);
        }
    }
    return missing;
}

// Cut at its saddles a trilinear function has no tunnels inside cells: faces tell all.
TEST(ExactHandles, OfTheTrilinearFunctionAreThoseOfItsFinerSamples) {
    std::mt19937 random(7);
    Index pairs = 0, faces_differ = 0;
    for (int i = 0; i < 150; ++i) {
        const Grid grid = noise(random, {3 + i % 2, 4, 3 + i / 2 % 2}, 1);
        const std::vector<HolePair> own = exact_pairs(grid, Interpolant::trilinear), fine = hole_pairs(Elements(cut_at_saddles(grid)));
        EXPECT_EQ(missing(own, fine, 1e-9), 0) << i;
        EXPECT_EQ(missing(fine, own, 1e-9), 0) << i;
        pairs += static_cast<Index>(own.size());
        faces_differ += missing(own, exact_pairs(grid, Interpolant::faces), 1e-9) > 0;
    }
    EXPECT_GT(pairs, 300);
    EXPECT_GT(faces_differ, 30);
}

void exact_handles_of_one_object_are_those_that_close_in_it() {
    const Grid grid = *arbitrary_grid(6, 120);
    const Volume volume = to_volume(grid);
    const Analysis analysis = isoatlas::analyse(volume, {.interpolant = *arbitrary_interpolant()});
    const std::vector<Handle> all = isoatlas::pair_handles_exactly(volume, analysis);
    const isoatlas::EventId event(*rc::gen::inRange(Index{0}, analysis.event_count()));
    const double low = analysis.event(event).zone.tau_low;
    std::vector<std::array<double, 8>> expected, found;
    const auto row = [](const Handle& h, double closes) {
        return std::array<double, 8>{h.opens, closes, h.opened_at[0], h.opened_at[1], h.opened_at[2], 0, 0, 0};
    };
    for (const Handle& handle : all) {
        isoatlas::EventId e = handle.event;
        while (e.exists() && e != event) e = analysis.event(e).parent;
        if (e == event) expected.push_back(row(handle, std::max(handle.closes, low)));
    }
    for (const Handle& handle : isoatlas::pair_handles_exactly(volume, analysis, {.event = event})) {
        RC_ASSERT(handle.is_open == (handle.closes == low));
        found.push_back(row(handle, handle.closes));
    }
    std::sort(expected.begin(), expected.end());
    std::sort(found.begin(), found.end());
    RC_ASSERT(found == expected);
}

TEST(ExactHandles, RejectTooMany) {
    Grid grid{3, {5, 5, 5}, {}};
    for (Index v = 0; v < grid.voxels(); ++v) grid.value.push_back(static_cast<double>(v * 7919 % 104729 % 31));
    const Volume volume = to_volume(grid);
    const Analysis analysis = isoatlas::analyse(volume);
    ASSERT_GT(isoatlas::pair_handles_exactly(volume, analysis).size(), 3U);
    EXPECT_THROW((void)isoatlas::pair_handles_exactly(volume, analysis, {.max = 3}), isoatlas::Error);
    EXPECT_THROW((void)isoatlas::pair_handles_exactly(volume, analysis, {.event = isoatlas::EventId(analysis.event_count())}),
                 isoatlas::Error);
}

TEST(ExactHandles, AreFoundWhereTheyCostLittle) {
    const Volume small = isoatlas::make_phantom("noise", {.size = 12});
    const Analysis analysis = isoatlas::analyse(small);
    const isoatlas::FoundHandles found = isoatlas::find_handles(small.info, analysis, 0.1, [&] { return small; });
    EXPECT_TRUE(found.exact);
    EXPECT_EQ(pairs_of(found.handles), pairs_of(isoatlas::pair_handles_exactly(small, analysis, {.min_persistence = 0.1})));
    isoatlas::VolumeInfo large = small.info;
    large.extent.size = {1024, 1024, 1024};
    const auto no_samples = []() -> Volume { throw std::logic_error("asked for samples"); };
    const isoatlas::FoundHandles approximate = isoatlas::find_handles(large, analysis, 0.1, no_samples);
    EXPECT_FALSE(approximate.exact);
    EXPECT_EQ(pairs_of(approximate.handles), pairs_of(isoatlas::pair_handles(analysis, 0.1)));
}

RC_GTEST_PROP(ExactHandles, EqualTheHomologyOfAWholeComplex, ()) { exact_handles_equal_the_homology_of_a_whole_complex(); }
RC_GTEST_PROP(ExactHandles, OpenAndCloseWhereTheApproximateOnesDo, ()) { exact_handles_open_and_close_where_the_approximate_ones_do(); }
RC_GTEST_PROP(ExactHandles, DoNotDependOnHowTheVolumeLiesOrOnThreads, ()) { handles_do_not_depend_on_how_the_volume_lies(); }
RC_GTEST_PROP(ExactHandles, OfOneObjectAreThoseThatCloseInIt, ()) { exact_handles_of_one_object_are_those_that_close_in_it(); }

}  // namespace
}  // namespace oracle
