// The pairs of cavities say, for any two isovalues, how many cavities of the upper one are not yet filled at the lower one: the ranks of
// the second homology (2D: the first), of which there is one set of pairs only.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <set>

#include "isoatlas/cavities.h"
#include "isoatlas/persistence.h"
#include "oracle/compare.h"
#include "oracle/difference.h"
#include "oracle/stores.h"
#include "oracle/volumes.h"

namespace oracle {
namespace {

using isoatlas::Analysis;
using isoatlas::CavityPair;
using isoatlas::Volume;

struct LowComponents {
    double tau;
    std::vector<std::uint32_t> cavity;  // of each voxel, from 1; 0: none
};

/// Cavities at the upper isovalue with a cavity of the lower one inside.
Index surviving(const LowComponents& upper, const LowComponents& lower) {
    std::set<std::uint32_t> cavities;
    for (std::size_t v = 0; v < upper.cavity.size(); ++v) {
        if (lower.cavity[v] > 0 && upper.cavity[v] > 0) cavities.insert(upper.cavity[v]);
    }
    return static_cast<Index>(cavities.size());
}

RC_GTEST_PROP(CavityPairs, AreThoseOfTheRanksOfPersistentHomology, ()) {
    const Grid grid = *arbitrary_grid(5, 80);
    const isoatlas::Interpolant interpolant = *arbitrary_interpolant();
    const Volume volume = to_volume(grid, arbitrary_type(grid));
    const Analysis analysis = isoatlas::analyse(volume, {.interpolant = interpolant});
    const std::vector<CavityPair> pairs = isoatlas::pair_cavities(analysis);
    for (const CavityPair& pair : pairs) RC_ASSERT(pair.persistence() > 0);
    std::vector<LowComponents> levels;
    for (const double tau : interesting_values(elements_of(grid, interpolant))) {
        std::vector<std::int64_t> ids;
        levels.push_back({tau, isoatlas::label_cavities(volume, analysis, tau, ids)});
    }
    for (const LowComponents& upper : levels) {
        for (const LowComponents& lower : levels) {
            if (lower.tau > upper.tau) continue;
            const auto lives =
                std::ranges::count_if(pairs, [&](const CavityPair& pair) { return pair.born >= upper.tau && pair.dies < lower.tau; });
            RC_ASSERT(lives == surviving(upper, lower));
        }
    }
}

TEST(CavityPairs, OfTwoHollowsLoseTheShallowOneInTheDeepOne) {
    // A row of samples inside a solid block: 1 and 3 are hollows, parted by 5; the block has 9.
    std::vector<float> samples(5 * 3 * 3, 9);
    const std::size_t row = 5 * (1 + 3 * 1);
    samples[row + 1] = 1, samples[row + 2] = 5, samples[row + 3] = 3;
    const Volume volume = isoatlas::make_volume<float>({.rank = 3, .size = {5, 3, 3}}, samples);
    const std::vector<CavityPair> pairs = isoatlas::pair_cavities(isoatlas::analyse(volume, {.interpolant = isoatlas::Interpolant::faces}));
    ASSERT_EQ(pairs.size(), 2U);
    EXPECT_EQ(pairs[0].born, 9);
    EXPECT_EQ(pairs[0].dies, 1);
    EXPECT_EQ(pairs[1].born, 5);
    EXPECT_EQ(pairs[1].dies, 3);
}

}  // namespace
}  // namespace oracle
