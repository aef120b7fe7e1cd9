// The pairs of objects say, for any two isovalues, how many objects of the upper one are still apart at the lower one: the ranks of
// the zeroth homology, of which there is one set of pairs only.
#include "isoatlas/persistence.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <set>

#include "oracle/compare.h"
#include "oracle/difference.h"
#include "oracle/stores.h"
#include "oracle/volumes.h"

namespace oracle {
namespace {

using isoatlas::Analysis;
using isoatlas::Cut;
using isoatlas::ObjectPair;
using isoatlas::Volume;

/// Objects at the lower isovalue that hold a High of the upper one.
Index surviving(const Cut& upper, const Cut& lower) {
    std::set<std::int32_t> objects;
    for (std::size_t v = 0; v < upper.label.size(); ++v) {
        if (upper.label[v] >= 0) objects.insert(lower.label[v]);
    }
    return static_cast<Index>(objects.size());
}

RC_GTEST_PROP(ObjectPairs, AreThoseOfTheRanksOfPersistentHomology, ()) {
    const Grid grid = *arbitrary_grid(5, 80);
    const isoatlas::Interpolant interpolant = *arbitrary_interpolant();
    const Volume volume = to_volume(grid, arbitrary_type(grid));
    const std::vector<ObjectPair> pairs = isoatlas::pair_objects(isoatlas::analyse(volume, {.interpolant = interpolant}));
    for (const ObjectPair& pair : pairs) {
        RC_ASSERT(pair.persistence() > 0);
        RC_ASSERT(pair.merge.exists() == std::isfinite(pair.dies));
    }
    std::vector<Cut> cuts;
    for (const double tau : interesting_values(elements_of(grid, interpolant)))
        cuts.push_back(isoatlas::cut(volume, tau, {.interpolant = interpolant, .label = true}));
    for (const Cut& upper : cuts) {
        for (const Cut& lower : cuts) {
            if (lower.tau > upper.tau) continue;
            const auto lives =
                std::ranges::count_if(pairs, [&](const ObjectPair& pair) { return pair.born >= upper.tau && pair.dies < lower.tau; });
            RC_ASSERT(lives == surviving(upper, lower));
        }
    }
}

TEST(ObjectPairs, OfAVolumeWithTwoPeaksLoseTheLowerOne) {
    const std::vector<float> samples{9, 1, 7, 3, 5};
    const Volume volume = isoatlas::make_volume<float>({.rank = 3, .size = {5, 1, 1}}, samples);
    const std::vector<ObjectPair> pairs = isoatlas::pair_objects(isoatlas::analyse(volume));
    ASSERT_EQ(pairs.size(), 3U);
    EXPECT_EQ(pairs[0].born, 9);
    EXPECT_FALSE(pairs[0].merge.exists());
    EXPECT_EQ(pairs[1].born, 7);
    EXPECT_EQ(pairs[1].dies, 1);
    EXPECT_EQ(pairs[2].born, 5);
    EXPECT_EQ(pairs[2].dies, 3);
}

}  // namespace
}  // namespace oracle
