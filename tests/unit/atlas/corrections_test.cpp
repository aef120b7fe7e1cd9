// A store with a corrected geometry answers as the store that would have been built with it.
#include <gtest/gtest.h>

#include <filesystem>

#include <unistd.h>

#include "isoatlas/atlas.h"
#include "isoatlas/build.h"
#include "isoatlas/filter.h"
#include "isoatlas/phantom.h"

namespace isoatlas {
namespace {

class CorrectedStores : public testing::Test {
protected:
    ~CorrectedStores() override {
        for (const char* name : {"before", "after"}) std::filesystem::remove(path(name));
    }
    static std::string path(const std::string& name) {
        return (std::filesystem::temp_directory_path() / ("isoatlas_corrected_" + name + std::to_string(::getpid()) + ".atlas")).string();
    }
    static Volume volume_of(const Geometry& geometry) {
        Volume volume = make_phantom("demo", {.size = 32});
        volume.info.geometry = geometry;
        return volume;
    }
};

const Geometry kOblique{
    .spacing = {1, 1, 3}, .origin = {5, 6, 7}, .direction = {{{0, 1, 0}, {1, 0, 0}, {0, 0, 1}}}, .space = "LPS", .unit = ""};

TEST_F(CorrectedStores, AnswerAsStoresThatWereBuiltSo) {
    const Corrections corrections{.spacing = Vec3{0.5, 0.25, 4}, .origin = Vec3{-1, 0, 2}, .unit = "um", .value_unit = "HU"};
    const Volume before = volume_of(kOblique);
    Volume after = before;
    correct(after.info, corrections);
    build_atlas(path("before"), before);
    build_atlas(path("after"), after);
    const Atlas corrected(path("before"), {.corrections = corrections}), built(path("after"));
    EXPECT_EQ(corrected.info().geometry, built.info().geometry);
    EXPECT_EQ(corrected.info().value_unit, "HU");
    const ObjectTable table = corrected.objects(), expected = built.objects();
    ASSERT_EQ(table.entries.size(), expected.entries.size());
    for (std::size_t i = 0; i < table.entries.size(); ++i) EXPECT_EQ(table.entries[i].measure, expected.entries[i].measure);
    const CavityTable cavities = corrected.cavities(), expected_cavities = built.cavities();
    ASSERT_EQ(cavities.entries.size(), expected_cavities.entries.size());
    for (std::size_t i = 0; i < cavities.entries.size(); ++i) EXPECT_EQ(cavities.entries[i].measure, expected_cavities.entries[i].measure);
    EXPECT_EQ(corrected.extract(100).points, built.extract(100).points);
    EXPECT_EQ(corrected.extract(100).unit, "\u00b5m");
    EXPECT_EQ(corrected.cut(100).objects[0].measure, built.cut(100).objects[0].measure);
    EXPECT_EQ(corrected.volume().info.geometry, built.volume().info.geometry);
    EXPECT_EQ(Atlas(path("before")).info().geometry, kOblique) << "in memory only";
}

TEST_F(CorrectedStores, OfFilteredSamplesKeepTheirSpacing) {
    build_atlas(path("before"), gaussian_filter(volume_of(kOblique), 2));
    EXPECT_THROW(Atlas(path("before"), {.corrections = {.spacing = Vec3{1, 1, 1}}}), Error);
    EXPECT_EQ(Atlas(path("before"), {.corrections = {.spacing = kOblique.spacing, .unit = "mm"}}).info().geometry.unit, "mm");
}

}  // namespace
}  // namespace isoatlas
