// Percolation and porosity equal flooding at every isovalue of random volumes with ties.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <set>

#include "isoatlas/measures.h"
#include "oracle/mesh_checks.h"

namespace oracle {
namespace {

/// Which components hold a voxel of one end face. of: component of a voxel, negative: none.
template <class Of>
std::set<Index> components_at(const Grid& grid, int axis, Index place, const Of& of) {
    std::set<Index> found;
    for (Index v = 0; v < grid.voxels(); ++v) {
        if (grid.voxel(v)[axis] == place && of(v) >= 0) found.insert(of(v));
    }
    return found;
}

template <class Of>
bool connects(const Grid& grid, int axis, const Of& of) {
    const std::set<Index> first = components_at(grid, axis, 0, of), last = components_at(grid, axis, grid.size[axis] - 1, of);
    return std::any_of(first.begin(), first.end(), [&](Index component) { return last.contains(component); });
}

/// The volume in a wall of High samples: inside it, low components are connected within the volume alone.
Grid walled(const Grid& grid) {
    Grid result{grid.rank, grid.size, {}};
    for (int axis = 0; axis < grid.rank; ++axis) result.size[axis] += 2;
    result.value.assign(static_cast<std::size_t>(result.voxels()), *std::max_element(grid.value.begin(), grid.value.end()) + 1);
    for (Index v = 0; v < grid.voxels(); ++v) {
        const std::array<Index, 3> p = grid.voxel(v);
        result.value[static_cast<std::size_t>(result.index(p[0] + 1, p[1] + 1, grid.rank == 3 ? p[2] + 1 : 0))] = grid.value[v];
    }
    return result;
}

bool is_close(double p, double q) { return std::abs(p - q) <= 1e-12 * std::max({1.0, std::abs(p), std::abs(q)}); }

/// From High samples at every value downwards.
void high_equals_flooding() {
    const Grid grid = *arbitrary_grid(6, 60);
    const isoatlas::AnalysisOptions options{.interpolant = *arbitrary_interpolant()};
    const Elements elements = elements_of(grid, options.interpolant);
    const isoatlas::Volume volume = to_volume(grid, arbitrary_type(grid));
    const isoatlas::Vec3 high = high_percolation(volume, analyse(volume, options), arbitrary_context());
    for (const double tau : interesting_values(elements)) {
        const Snapshot at = snapshot(elements, elements.cut_at(tau));
        for (int axis = 0; axis < 3; ++axis) {
            const bool percolates = connects(grid, axis, [&](Index v) { return at.object_of[v]; });
            RC_ASSERT(percolates == (tau <= high[axis]));
        }
    }
}

void low_equals_flooding() {
    const Grid grid = *arbitrary_grid(5, 40), wall = walled(grid);
    const isoatlas::AnalysisOptions options{.interpolant = *arbitrary_interpolant()};
    const Elements elements = elements_of(wall, options.interpolant);
    const isoatlas::Volume volume = to_volume(grid, arbitrary_type(grid));
    const isoatlas::Percolation both = percolation(volume, options, arbitrary_context());
    RC_ASSERT(both.high == high_percolation(volume, analyse(volume, options)));
    const double highest = *std::max_element(grid.value.begin(), grid.value.end());
    for (const double tau : interesting_values(elements)) {
        if (tau > highest + 0.5) continue;  // the wall is Low too
        const Snapshot at = snapshot(elements, elements.cut_at(tau));
        const auto low_of = [&](Index v) -> Index {
            const std::array<Index, 3> p = grid.voxel(v);
            return at.low_of[wall.index(p[0] + 1, p[1] + 1, grid.rank == 3 ? p[2] + 1 : 0)];
        };
        for (int axis = 0; axis < 3; ++axis) {
            const bool percolates = connects(grid, axis, low_of);
            RC_ASSERT(percolates == (tau > both.low[axis]) || is_close(tau, both.low[axis]));
        }
    }
}

RC_GTEST_PROP(Percolation, OfHighValuesEqualsFlooding, ()) { high_equals_flooding(); }
RC_GTEST_PROP(Percolation, OfLowValuesEqualsFlooding, ()) { low_equals_flooding(); }

// A plate of 5 in the middle of a volume of 1, with a hole of 3: high values pass along x and y at 5, along z at 1; low ones along z
// above 3.
TEST(Percolation, PlateWithAHole) {
    Grid grid{3, {3, 3, 3}, std::vector<double>(27, 1)};
    for (Index i = 9; i < 18; ++i) grid.value[static_cast<std::size_t>(i)] = 5;
    grid.value[13] = 3;
    for (const isoatlas::ValueType type : {isoatlas::ValueType::u8, isoatlas::ValueType::i16, isoatlas::ValueType::f32}) {
        const isoatlas::Percolation both = isoatlas::percolation(to_volume(grid, type));
        EXPECT_EQ(both.high, (isoatlas::Vec3{5, 5, 1}));
        EXPECT_EQ(both.low, (isoatlas::Vec3{1, 1, 3}));
    }
}

TEST(Percolation, NeedsZonesOfThisVolume) {
    const isoatlas::Volume volume = to_volume({3, {2, 2, 2}, std::vector<double>(8, 1)});
    const isoatlas::Volume other = to_volume({3, {3, 2, 2}, std::vector<double>(12, 1)});
    EXPECT_THROW((void)high_percolation(volume, analyse(other)), isoatlas::Error);
    EXPECT_THROW((void)high_percolation(volume, analyse(volume, {.zones = false})), isoatlas::Error);
}

RC_GTEST_PROP(Porosity, CountsSamples, ()) {
    const Grid grid = *arbitrary_grid();
    const isoatlas::Volume volume = to_volume(grid, arbitrary_type(grid));
    const std::vector<double> taus = interesting_values(elements_of(grid, isoatlas::Interpolant::faces));
    const std::vector<std::int64_t> below = samples_below(volume, taus, arbitrary_context());
    RC_ASSERT(below.size() == taus.size());
    for (std::size_t i = 0; i < taus.size(); ++i)
        RC_ASSERT(below[i] == std::count_if(grid.value.begin(), grid.value.end(), [&](double v) { return v < taus[i]; }));
}

TEST(Porosity, IsovaluesAscend) {
    const isoatlas::Volume volume = to_volume({3, {2, 2, 2}, std::vector<double>(8, 1)});
    EXPECT_THROW((void)samples_below(volume, std::vector<double>{2, 1}), isoatlas::Error);
    EXPECT_THROW((void)samples_below(volume, std::vector<double>{std::nan("")}), isoatlas::Error);
    EXPECT_TRUE(samples_below(volume, {}).empty());
}

}  // namespace
}  // namespace oracle
