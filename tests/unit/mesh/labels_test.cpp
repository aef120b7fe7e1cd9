// Labels: every label is the object of its own binary volume, whatever lies around it.
#include "isoatlas/labels.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "isoatlas/cut.h"

namespace isoatlas {
namespace {

Volume random_labels(int rank) {
    const Extent extent{.rank = rank, .size = {*rc::gen::inRange(1, 8), *rc::gen::inRange(1, 8), rank == 2 ? 1 : *rc::gen::inRange(1, 7)}};
    Volume volume = make_volume(extent, ValueType::u16, {.spacing = {0.5, 2, 3}, .origin = {1, -2, 3}, .space = "LPS", .unit = "mm"});
    const std::uint16_t names[] = {0, 3, 4, 700};
    for (std::uint16_t& sample : volume.samples<std::uint16_t>()) sample = names[*rc::gen::inRange(0, 4)];
    return volume;
}

/// 1 where the label is, in the whole volume.
Volume mask_of(const Volume& volume, std::int64_t label) {
    Volume mask = make_volume(volume.info.extent, ValueType::u8, volume.info.geometry);
    std::ranges::transform(volume.samples<std::uint16_t>(), mask.samples<std::uint8_t>().begin(),
                           [&](std::uint16_t sample) { return static_cast<std::uint8_t>(sample == label); });
    return mask;
}

void expect_regions_of_brute_force(int rank, Interpolant interpolant) {
    const Volume volume = random_labels(rank);
    const LabelTable table = list_labels(volume, {.interpolant = interpolant});
    std::map<std::int64_t, std::int64_t> counts;
    for (const std::uint16_t sample : volume.samples<std::uint16_t>()) ++counts[sample];
    RC_ASSERT(table.background == (counts.contains(0) ? counts.at(0) : 0));
    counts.erase(0);
    RC_ASSERT(table.regions.size() == counts.size());
    for (const LabelRegion& region : table.regions) {
        const Volume mask = mask_of(volume, region.label);
        const Cut at = cut(mask, 0.5, {.interpolant = interpolant});
        RC_ASSERT(region.voxels == counts.at(region.label));
        RC_ASSERT(region.components == std::ssize(at.objects));
        std::int64_t tunnels = 0, cavities = 0;
        Index3 low = volume.info.extent.size, high{};
        for (const CutObject& object : at.objects) {
            tunnels += object.b1, cavities += object.b2;
            low = min(low, object.box_low), high = max(high, object.box_high);
        }
        RC_ASSERT(region.tunnels == tunnels);
        RC_ASSERT(region.cavities == cavities);
        RC_ASSERT(region.box_low == low);
        RC_ASSERT(region.box_high == high);
        const double voxel = voxel_measure(volume.info.geometry, volume.info.extent, 0);
        RC_ASSERT(std::abs(region.measure - voxel * static_cast<double>(region.voxels)) < 1e-9 * region.measure);
    }
}

RC_GTEST_PROP(LabelRegions, AreThoseOfTheMaskOfTheWholeVolume, ()) { expect_regions_of_brute_force(3, Interpolant::trilinear); }
RC_GTEST_PROP(LabelRegions, AreThoseOfTheMaskByFacesToo, ()) { expect_regions_of_brute_force(3, Interpolant::faces); }
RC_GTEST_PROP(LabelRegions, AreThoseOfTheMaskOfAnImage, ()) { expect_regions_of_brute_force(2, Interpolant::trilinear); }

RC_GTEST_PROP(LabelSurfaces, AreThoseOfTheMaskOfTheWholeVolume, ()) {
    const Volume volume = random_labels(3);
    for (const LabelRegion& region : list_labels(volume).regions) {
        const Surface part = extract_label(volume, region.label), whole = extract(mask_of(volume, region.label), 0.5);
        RC_ASSERT(part.triangles.size() == whole.triangles.size());
        RC_ASSERT(part.points.size() == whole.points.size());
        const SurfaceReport report = inspect(part.points, part.triangles);
        RC_ASSERT(report.is_closed());
        RC_ASSERT(report.is_manifold());
        RC_ASSERT(report.is_oriented());
        const auto chi = std::accumulate(report.component_chi.begin(), report.component_chi.end(), std::int64_t{0});
        RC_ASSERT(chi == 2 * (region.components - region.tunnels + region.cavities));
        RC_ASSERT(std::ranges::all_of(part.object, [&](std::int64_t id) { return id == region.label; }));
        RC_ASSERT(part.unit == "mm");
        auto sorted = [](auto points) {
            std::ranges::sort(points);
            return points;
        };
        const auto here = sorted(part.points), there = sorted(whole.points);
        for (std::size_t i = 0; i < here.size(); ++i) {
            for (std::size_t axis = 0; axis < 3; ++axis) RC_ASSERT(std::abs(here[i][axis] - there[i][axis]) < 1e-12);
        }
        auto contours = part.contour, expected = whole.contour;
        std::ranges::sort(contours);
        std::ranges::sort(expected);
        RC_ASSERT(contours == expected);
    }
}

TEST(Labels, OfValuesAreRefused) {
    for (const float wrong : {0.5F, -1.0F, std::numeric_limits<float>::quiet_NaN()}) {
        const Volume volume = make_volume<float>({.rank = 3, .size = {2, 2, 2}}, std::vector<float>{0, 1, 1, 2, 2, wrong, 3, 0});
        EXPECT_THROW((void)list_labels(volume), Error);
    }
    const Volume volume = make_volume<std::uint16_t>({.rank = 3, .size = {2, 2, 2}}, std::vector<std::uint16_t>{1, 2, 3, 4, 5, 6, 7, 8});
    EXPECT_EQ(list_labels(volume).regions.size(), 8U);
    EXPECT_THROW((void)list_labels(volume, {.max_labels = 7}), Error);
    EXPECT_THROW((void)extract_label(volume, 9), Error);
}

}  // namespace
}  // namespace isoatlas
