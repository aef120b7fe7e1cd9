// Zones found by heavy paths are those found by climbing event by event.
#include "tree/heavy_paths.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "unit/tree/drawings.h"

namespace isoatlas {
namespace {

/// The event e on the way from a maximum to the root with value(parent(e)) < x <= value(e).
Id climbed(const DescendingTree<Id>& tree, EventKey e, double x) {
    while (!tree.is_root(e) && tree.value[tree.top_of(tree.parent[e])] >= x) e = tree.parent[e];
    return e.number();
}

Ids zones_of(const DescendingTree<Id>& tree, const Ids& maxima, Ids maximum, const std::vector<double>& x) {
    const HeavyPathDecomposition<Id, double> paths(tree, IdSpan<MaximumIdOf<Id>, const ElementKey>(ids_of<ElementKey>(maxima)), 1);
    std::vector<std::uint32_t> scratch(x.size());
    Ids zone(x.size());
    paths.zones(x, maximum, scratch, zone);
    return zone;
}

//   A  B  C       100  82  66
//   `s1'  |         54
//     `s2-'           40
//     closes          22
//     m               10 (on the wall of the lake, but of the same object)
TEST(HeavyPaths, OfIslandsLeadToTheirEvents) {
    Ids join = list(islands().join());
    join.pop_back();  // the outside
    const std::vector<double> values = islands().values;
    const auto tree = DescendingTree<Id>::of_elements(tree_of(join), by_element(values));
    EXPECT_EQ(zones_of(tree, {0, 1, 2}, {0, 0, 0, 1, 2, 2, 1}, {60, 54, 54.5, 40, 30, 5, 82}), (Ids{0, 3, 0, 4, 4, 6, 1}));
}

// A path of random length with side branches, with and without equal values.
RC_GTEST_PROP(HeavyPaths, LeadWhereClimbingLeads, ()) {
    const auto n = *rc::gen::element<Id>(1, 2, 5, 40, 300);
    const auto reach = *rc::gen::element<Id>(1, 2, 20, 300), step = *rc::gen::element<Id>(1, 3);
    Ids parent(n), maxima;
    std::vector<double> values(n);
    std::vector<bool> is_leaf(n, true);
    std::uint64_t state = *rc::gen::inRange<std::uint64_t>(0, 1000000);
    for (Id i = 0; i < n; ++i) {
        state = state * 6364136223846793005U + 1442695040888963407U;
        parent[i] = i + 1 == n ? i : i + 1 + static_cast<Id>(state >> 33) % std::min(n - 1 - i, reach);
        values[i] = static_cast<double>((n - i) / step);
        if (parent[i] != i) is_leaf[parent[i]] = false;
    }
    for (Id i = 0; i < n; ++i) {
        if (is_leaf[i]) maxima.push_back(i);
    }
    const auto tree = DescendingTree<Id>::of_elements(tree_of(parent), by_element(values));
    std::vector<double> x;
    Ids maximum, expected;
    for (int sample = 0; sample < 50; ++sample) {
        const Id m = *rc::gen::inRange<Id>(0, static_cast<Id>(maxima.size()));
        const double top = values[maxima[m]];
        maximum.push_back(m);
        x.push_back(std::min(top, *rc::gen::inRange(-2, 2 * static_cast<int>(top) + 1) / 2.0));
        expected.push_back(climbed(tree, EventKey(maxima[m]), x.back()));
    }
    RC_ASSERT(zones_of(tree, maxima, maximum, x) == expected);
}

}  // namespace
}  // namespace isoatlas
