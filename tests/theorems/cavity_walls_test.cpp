// Bodies with their cavities filled are those of brute force; boundaries that are sharp at different isovalues are told apart.
#include "features/cavity_walls.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <map>
#include <numeric>

#include "features/noise.h"
#include "isoatlas/cavities.h"
#include "oracle/difference.h"
#include "oracle/mesh_checks.h"

namespace oracle {
namespace {

using isoatlas::Analysis;
using isoatlas::BranchHistogram;
using isoatlas::IsovalueReason;
using isoatlas::RecommendedIsovalue;
using isoatlas::Volume;

/// The object around each low component and the low component around each object, found from the outside inwards.
struct Nesting {
    std::vector<Index> around_low, around_object;

    explicit Nesting(const Snapshot& at) : around_low(at.lows.size(), -1), around_object(at.objects.size(), -1) {
        std::vector<Index> lows{0};
        while (!lows.empty()) {
            const Index low = lows.back();
            lows.pop_back();
            for (const Contour& outer : at.contours) {
                if (outer.low != low || outer.object == around_low[low]) continue;
                around_object[outer.object] = low;
                for (const Index c : at.objects[outer.object].contours) {
                    if (at.contours[c].low == low) continue;
                    around_low[at.contours[c].low] = outer.object;
                    lows.push_back(at.contours[c].low);
                }
            }
        }
    }
};

/// In a cavity of an object, or in something inside one?
bool is_in_cavity(const Snapshot& at, const Nesting& nesting, Index v, Index object) {
    Index low = at.low_of[v] >= 0 ? at.low_of[v] : nesting.around_object[at.object_of[v]];
    for (; low > 0; low = nesting.around_object[nesting.around_low[low]]) {
        if (nesting.around_low[low] == object) return true;
    }
    return false;
}

/// Every branch with every cavity filled, at every isovalue that tells.
bool are_filled_as_brute_force_says(const Grid& grid, isoatlas::Interpolant interpolant) {
    bool same = true;
    const Volume volume = to_volume(grid, isoatlas::ValueType::f64);
    const Analysis analysis = isoatlas::analyse(volume, {.interpolant = interpolant});
    const Elements elements = elements_of(grid, interpolant);
    const isoatlas::VolumeView view(volume);
    const isoatlas::RankOptions all{.top = 0, .gate = false};
    analysis.data().visit([&]<class Id>(const isoatlas::IndexedArrays<Id>& held) {
        const isoatlas::NoiseModel noise = isoatlas::fit_noise(view);
        const isoatlas::IdArray<isoatlas::EventId, double> values(isoatlas::event_values(held.arrays));
        const auto bright = isoatlas::superlevel_tree<Id>(held.arrays, values.items());
        const isoatlas::BranchDecomposition branches = isoatlas::decompose_branches(bright, isoatlas::sum_zones(bright, view));
        const auto dark = isoatlas::make_cavity_candidates(view, held.arrays, noise, all, {});
        const auto around = isoatlas::enclosures(bright, branches, dark, isoatlas::objects_around(analysis, held.arrays, dark));
        const std::vector<BranchHistogram> filled = isoatlas::fill_cavities(
            view, bright, branches, isoatlas::find_candidates(view, bright, branches, noise, all).histograms, dark, around);
        for (const BranchHistogram& histogram : filled) {
            const isoatlas::Branch& branch = branches.branch[histogram.branch];
            std::vector<bool> was_in_cavity(static_cast<std::size_t>(grid.voxels()), false);
            double below = std::max(branch.merges, branches.lowest);
            for (const double tau : interesting_values(elements)) {
                if (!(branch.merges < tau && tau <= branch.appears) || tau <= branches.lowest) continue;
                isoatlas::EventId event = branch.top;
                while (!bright.is_root(event) && values[bright.parent(event)] >= tau) event = bright.parent(event);
                const Snapshot at = snapshot(elements, elements.cut_at(tau));
                const Nesting nesting(at);
                const Index object =
                    at.object_of[isoatlas::ElementCode{held.arrays.code[held.arrays.tree.top[branches.highest[event]]]}.index()];
                Index count = 0;
                for (Index v = 0; v < grid.voxels(); ++v) {
                    if (is_in_cavity(at, nesting, v, object)) was_in_cavity[v] = true;
                    count += at.object_of[v] == object || was_in_cavity[v];
                }
                // An edge of a bin between the last isovalue and this one: nothing happens between them.
                const double edge = std::ceil((histogram.axis.position(below) - histogram.low) / histogram.width() + 1e-6);
                const bool has_edge = edge >= 1 && histogram.axis.height(histogram.low + edge * histogram.width()) < tau - 1e-6;
                below = tau;
                if (!has_edge) continue;
                const auto first = histogram.added.begin() + static_cast<std::ptrdiff_t>(edge);
                same = same && static_cast<double>(count) == std::accumulate(first, histogram.added.end(), 0.0);
            }
        }
    });
    return same;
}

void cavity_walls_are_filled_as_brute_force_says() {
    RC_ASSERT(are_filled_as_brute_force_says(*arbitrary_grid(6, 90), *arbitrary_interpolant()));
}

// The cavity in the middle meets the one around its ring at 4, above the value 3 at which that ring joins the outer one.
TEST(CavityWalls, AreFilledInsideOneAnother) {
    const Grid grid{2, {8, 7, 1}, {8, 8, 8, 8, 8,   8, 8, 8,  //
                                   8, 1, 1, 1, 1,   1, 1, 8,  //
                                   8, 1, 6, 6, 6,   6, 1, 8,  //
                                   8, 3, 6, 0, 3.5, 4, 1, 8,  //
                                   8, 1, 6, 6, 6,   6, 1, 8,  //
                                   8, 1, 1, 1, 1,   1, 1, 8,  //
                                   8, 8, 8, 8, 8,   8, 8, 8}};
    EXPECT_TRUE(are_filled_as_brute_force_says(grid, isoatlas::Interpolant::trilinear));
}

/// How far an edge has moved at a value: slowly around `sharp`, where the gradient is large.
double moved(double value, double sharp) {
    constexpr double kWidth = 32;
    const auto slow = [&](double to) { return std::sqrt(std::acos(-1.0)) / 2 * kWidth * std::erf((to - sharp) / kWidth); };
    return 0.03 * (value - 0.9 * (slow(value) - slow(0)));
}

/// The value at which the edge has moved so far, 0 to 200.
double value_at(double way, double sharp) {
    double low = 0, high = 200;
    for (int i = 0; i < 30; ++i) {
        const double middle = (low + high) / 2;
        (moved(middle, sharp) < way ? low : high) = middle;
    }
    return std::round(low);
}

/// A hollow ball, its middle at no symmetric place; its outer edge is sharpest at one value, that of its cavity at another.
Volume hollow_ball(double outer, double inner) {
    constexpr Index kSize = 56;
    Grid grid{3, {kSize, kSize, kSize}, {}};
    for (Index v = 0; v < grid.voxels(); ++v) {
        const std::array<Index, 3> at = grid.voxel(v);
        const double x = static_cast<double>(at[0]) - 27.36, y = static_cast<double>(at[1]) - 27.71, z = static_cast<double>(at[2]) - 27.13;
        const double r = std::sqrt(x * x + y * y + z * z);
        grid.value.push_back(std::min(value_at(24 - r, outer), value_at(r - 14.5, inner)));
    }
    return to_volume(grid, isoatlas::ValueType::u8);
}

TEST(CavityWalls, AreSharpAtOtherIsovaluesThanTheOuterBoundary) {
    const Volume volume = hollow_ball(120, 80);
    const Analysis analysis = isoatlas::analyse(volume);
    const isoatlas::ObjectTable table = isoatlas::rank_objects(volume, analysis);
    ASSERT_FALSE(table.entries.empty());
    std::map<IsovalueReason, std::vector<RecommendedIsovalue>> by_reason;
    for (const RecommendedIsovalue& isovalue : isovalues_of(table.isovalues, table.entries[0].branch_top.number()))
        by_reason[isovalue.reason].push_back(isovalue);
    const auto& outer = by_reason[IsovalueReason::outer];
    ASSERT_EQ(outer.size(), 1U);
    EXPECT_NEAR(outer[0].tau, 120, 8);
    EXPECT_EQ(outer[0].cavity, -1);
    const auto& inner = by_reason[IsovalueReason::inner];
    ASSERT_EQ(inner.size(), 1U);
    EXPECT_NEAR(inner[0].tau, 80, 8);
    const isoatlas::CavityTable dark = rank_cavities(volume, analysis);
    ASSERT_EQ(dark.entries.size(), 1U);
    EXPECT_EQ(inner[0].cavity, dark.entries[0].id);
    EXPECT_EQ(inner[0].tau, dark.entries[0].best_tau);
    const auto& stable = by_reason[IsovalueReason::stable];  // in between, where neither boundary is sharp
    ASSERT_EQ(stable.size(), 1U);
    EXPECT_NEAR(stable[0].tau, 105, 8);
}

TEST(CavityWalls, AddNoIsovalueWhereBothBoundariesAreSharpAtOne) {
    const Volume volume = hollow_ball(100, 100);
    const isoatlas::ObjectTable table = isoatlas::rank_objects(volume, isoatlas::analyse(volume));
    EXPECT_FALSE(table.isovalues.empty());
    for (const RecommendedIsovalue& isovalue : table.isovalues)
        EXPECT_TRUE(isovalue.reason != IsovalueReason::outer && isovalue.reason != IsovalueReason::inner) << isovalue.tau;
}

RC_GTEST_PROP(CavityWalls, AreFilledAsBruteForceSays, ()) { cavity_walls_are_filled_as_brute_force_says(); }

}  // namespace
}  // namespace oracle
