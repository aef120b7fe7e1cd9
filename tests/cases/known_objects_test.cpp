// Real volumes: what somebody who knows the thing would name has a line, at about the isovalue at which it was seen
// (docs/theory/7-which-objects-matter.md#seen-on-real-volumes).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "isoatlas/cavities.h"
#include "isoatlas/objects.h"

namespace isoatlas {
namespace {

namespace fs = std::filesystem;

struct Range {
    const char* name;
    double low, high;  ///< reported values
};

struct Known {
    const char* file;
    std::vector<Range> main_branch;  ///< lines of the largest object, in their order
    std::vector<Range> dark;         ///< lines of dark objects, the first of them by rank
};

/// The first line of the largest object from `from` on whose isovalue lies in the range; lines.size(): none.
std::size_t find_line(const std::vector<ObjectEntry>& lines, std::size_t from, const Range& range, const Calibration& scale) {
    const auto is_there = [&](const ObjectEntry& line) {
        const double tau = scale.reported(line.best_tau);
        return line.main_branch && range.low <= tau && tau <= range.high;
    };
    return static_cast<std::size_t>(std::find_if(lines.begin() + static_cast<std::ptrdiff_t>(from), lines.end(), is_there) - lines.begin());
}

TEST(KnownObjects, HaveLines) {
    const fs::path data = fs::path(ISOATLAS_SOURCE_DIR).parent_path() / "shared" / "data";
    if (!fs::exists(data)) GTEST_SKIP() << "no shared data beside the checkout";
    const std::vector<Known> all{
        {"tooth/tooth.nrrd", {{"dentine", 550, 680}, {"enamel", 930, 1050}}, {{"pulp", 250, 650}}},
        {"engine/engine.nrrd", {{"block", 60, 100}, {"inserts", 155, 190}}, {}},
        {"headsq/headsq.nrrd", {{"skin", 450, 700}, {"skull", 1150, 1450}}, {}},
        {"bonsai/bonsai.nrrd", {{"leaves without the table", 19, 30}, {"wood and pot", 45, 75}, {"pot", 170, 210}}, {}},
        {"pet/pet.nrrd", {{"patient", 200, 1100}, {"bladder", 8000, 12000}}, {}},
    };
    for (const Known& known : all) {
        SCOPED_TRACE(known.file);
        const Volume volume = load_volume((data / known.file).string());
        const Analysis analysis = analyse(volume);
        const ObjectTable table = rank_objects(volume, analysis);
        std::size_t line = 0;
        for (const Range& range : known.main_branch) {
            line = find_line(table.entries, line, range, volume.info.calibration);
            EXPECT_LT(line, table.entries.size()) << range.name;
        }
        const CavityTable dark = known.dark.empty() ? CavityTable{} : rank_cavities(volume, analysis);
        for (std::size_t i = 0; i < known.dark.size(); ++i) {
            ASSERT_LT(i, dark.entries.size()) << known.dark[i].name;
            EXPECT_GE(dark.entries[i].best_tau, known.dark[i].low) << known.dark[i].name;
            EXPECT_LE(dark.entries[i].best_tau, known.dark[i].high) << known.dark[i].name;
        }
    }
}

// The skin of the average head is sharpest where its cavities begin to open: only with these filled is that seen.
/// A block, and a hill with a spike of 36 voxels: the only sharp edge of the hill is that of the spike.
Volume hill_with_spike(double spike) {
    const Extent extent{3, {100, 60, 60}};
    std::vector<float> samples(static_cast<std::size_t>(extent.voxels()), 0.0F);
    const auto set = [&](std::int64_t x, std::int64_t y, std::int64_t z, double value) {
        samples[static_cast<std::size_t>(extent.index(x, y, z))] = static_cast<float>(value);
    };
    for (std::int64_t z = 0; z < 60; ++z) {
        for (std::int64_t y = 0; y < 60; ++y) {
            for (std::int64_t x = 0; x < 100; ++x) {
                const double away = std::hypot(static_cast<double>(x - 70), static_cast<double>(y - 30), static_cast<double>(z - 30));
                if (x < 35) set(x, y, z, 300);
                if (x >= 40) set(x, y, z, std::max(0.0, 100 - 4 * away));
                if (std::abs(x - 70) <= 1 && std::abs(y - 30) <= 1 && 28 <= z && z < 32) set(x, y, z, spike);
            }
        }
    }
    return make_volume<float>(extent, samples);
}

TEST(KnownObjects, AreNotShownByAHundredthOfThem) {
    for (const auto& [spike, is_hill] : {std::pair{150.0, true}, {100000.0, false}}) {  // of which the latter is most of the object
        const Volume volume = hill_with_spike(spike);
        const ObjectTable table = rank_objects(volume, analyse(volume));
        const auto hill = std::ranges::find_if(table.entries, [](const ObjectEntry& entry) { return entry.position[0] > 40; });
        ASSERT_NE(hill, table.entries.end());
        EXPECT_EQ(hill->voxels > 1000, is_hill) << spike << ": " << hill->voxels << " voxels at " << hill->best_tau;
    }
}

/// White matter is an object of its own above 275, and falls apart into noise long before its few brightest voxels.
TEST(KnownObjects, AreShownWhereTheyAreMoreThanAFewVoxels) {
    const fs::path file = fs::path(ISOATLAS_SOURCE_DIR).parent_path() / "shared" / "data" / "seg3d_mr" / "seg3d_mr.nrrd";
    if (!fs::exists(file)) GTEST_SKIP() << "no shared data beside the checkout";
    const Volume volume = load_volume(file.string());
    const ObjectTable table = rank_objects(volume, analyse(volume));
    const auto largest = std::ranges::find_if(table.entries, [](const ObjectEntry& entry) { return !entry.main_branch; });
    ASSERT_NE(largest, table.entries.end());
    EXPECT_GT(largest->voxels, 200000);
    EXPECT_LT(largest->best_tau, 290);
}

TEST(KnownObjects, HaveAnOuterBoundaryOfTheirOwn) {
    const fs::path file = fs::path(ISOATLAS_SOURCE_DIR).parent_path() / "shared" / "data" / "avg152T1" / "avg152T1.nrrd";
    if (!fs::exists(file)) GTEST_SKIP() << "no shared data beside the checkout";
    const Volume volume = load_volume(file.string());
    const ObjectTable table = rank_objects(volume, analyse(volume));
    const auto outer = std::ranges::find(table.isovalues, IsovalueReason::outer, &RecommendedIsovalue::reason);
    ASSERT_NE(outer, table.isovalues.end());
    EXPECT_EQ(outer->branch_top, table.entries[0].branch_top.number());
    EXPECT_TRUE(35 < outer->tau && outer->tau < 55) << outer->tau;
    EXPECT_TRUE(std::ranges::any_of(table.isovalues, [](const RecommendedIsovalue& i) { return i.reason == IsovalueReason::inner; }));
}

}  // namespace
}  // namespace isoatlas
