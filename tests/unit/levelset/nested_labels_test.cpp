// A voxel has the label of the innermost object that holds it, against asking every object for every voxel.
#include "isoatlas/nested_labels.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "isoatlas/cut.h"
#include "isoatlas/error.h"
#include "isoatlas/volume.h"

namespace isoatlas {
namespace {

Volume random_volume(int size, int values) {
    Volume volume = make_volume({3, {size, size, size}}, ValueType::u8);
    for (std::byte& sample : volume.bytes) sample = static_cast<std::byte>(*rc::gen::inRange(0, values));
    return volume;
}

NestedSource source_of(const Volume& volume) {
    return {[&volume](double tau) { return cut(volume, tau, {.label = true}).label; }, {}};
}

/// The highest isovalue wins, then the first part.
std::uint32_t label_at(const Volume& volume, const std::vector<NestedPart>& parts, std::size_t voxel) {
    std::uint32_t label = 0;
    double highest = -1;
    for (const NestedPart& part : parts) {
        const Cut at = cut(volume, part.tau, {.label = true});
        const std::int32_t own = at.label[static_cast<std::size_t>(part.voxel)];
        if (at.label[voxel] == own && part.tau > highest) highest = part.tau, label = part.label;
    }
    return label;
}

RC_GTEST_PROP(NestedLabels, AreTheInnermostObjects, ()) {
    const Volume volume = random_volume(*rc::gen::inRange(2, 5), 6);
    const auto samples = std::span(reinterpret_cast<const std::uint8_t*>(volume.bytes.data()), volume.bytes.size());
    std::vector<NestedPart> parts;
    for (int i = *rc::gen::inRange(1, 6); i > 0; --i) {
        const auto voxel = *rc::gen::inRange<std::int64_t>(0, volume.info.extent.voxels());
        if (samples[static_cast<std::size_t>(voxel)] == 0) continue;
        const double tau = *rc::gen::inRange(1, samples[static_cast<std::size_t>(voxel)] + 1);
        parts.push_back({false, voxel, tau, static_cast<std::uint32_t>(10 * i)});
    }
    const std::vector<std::uint32_t> labels = nested_labels(volume.info.extent.voxels(), parts, source_of(volume));
    for (std::size_t v = 0; v < labels.size(); ++v) RC_ASSERT(labels[v] == label_at(volume, parts, v));
}

TEST(NestedLabels, CavitiesHideObjects) {
    const NestedSource source{
        [](double) { return std::vector<std::int32_t>{0, 0, 0, 0, -1}; },
        [](double tau) { return tau > 1 ? std::vector<std::uint32_t>{0, 1, 1, 0, 0} : std::vector<std::uint32_t>{0, 0, 1, 0, 0}; }};
    const std::vector<NestedPart> parts{{true, 2, 1, 7}, {true, 1, 2, 8}, {false, 0, 5, 9}};
    EXPECT_EQ(nested_labels(5, parts, source), (std::vector<std::uint32_t>{9, 8, 7, 9, 0}));
}

TEST(NestedLabels, SayWhichPartIsNotThere) {
    const NestedSource source{[](double) { return std::vector<std::int32_t>{-1, 0}; }, {}};
    try {
        (void)nested_labels(2, std::vector<NestedPart>{{false, 1, 1, 1}, {false, 0, 1, 2}}, source);
        ADD_FAILURE();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::not_found);
        EXPECT_EQ(error.text().where, "part 1");
    }
    EXPECT_THROW((void)nested_labels(2, std::vector<NestedPart>{{false, 2, 1, 1}}, source), Error);
    EXPECT_THROW((void)nested_labels(2, std::vector<NestedPart>{{false, 0, 1, 0}}, source), Error);
    EXPECT_EQ(nested_labels(2, {}, source), (std::vector<std::uint32_t>{0, 0}));
}

TEST(NestedLabels, OverlaysLeaveSharedVoxelsToTheSmallerOne) {
    std::vector<std::uint32_t> labels{1, 1, 1, 2, 0, 0};
    overlay_labels(labels, std::vector<std::uint32_t>{0, 5, 5, 5, 5, 6});
    EXPECT_EQ(labels, (std::vector<std::uint32_t>{1, 1, 1, 2, 5, 6}));  // 4 voxels of 5, 3 of 1, 1 of 2
    overlay_labels(labels, std::vector<std::uint32_t>{7, 0, 0, 0, 8, 0});
    EXPECT_EQ(labels, (std::vector<std::uint32_t>{7, 1, 1, 2, 5, 6}));  // of equal ones that which was there
}

}  // namespace
}  // namespace isoatlas
