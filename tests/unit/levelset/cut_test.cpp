#include "isoatlas/cut.h"

#include <gtest/gtest.h>

#include <cmath>

namespace isoatlas {
namespace {

Volume volume_of(int rank, Index3 size, const std::vector<std::uint8_t>& samples) {
    Extent extent;
    extent.rank = rank;
    extent.size = size;
    return make_volume<std::uint8_t>(extent, samples);
}

/// 5^3: a shell of 1 voxel thickness (value 9, corner voxel 10) around a cavity of 27 voxels (value 2, one 1) with a seed (7) in the
/// middle.
Volume nested() {
    std::vector<std::uint8_t> samples(125, 9);
    const auto at = [&](int x, int y, int z) -> std::uint8_t& { return samples[x + 5 * (y + 5 * z)]; };
    for (int z = 1; z < 4; ++z) {
        for (int y = 1; y < 4; ++y) {
            for (int x = 1; x < 4; ++x) at(x, y, z) = 2;
        }
    }
    at(2, 2, 2) = 7;
    at(1, 3, 2) = 1;
    at(3, 1, 2) = 1;
    at(4, 4, 0) = 10;
    return volume_of(3, {5, 5, 5}, samples);
}

TEST(Cut, AShellWithASeedInside) {
    Volume volume = nested();
    volume.info.geometry.spacing = {2, 3, 0.5};
    const Extent& extent = volume.info.extent;
    const Cut cut = isoatlas::cut(volume, 5, {.interpolant = Interpolant::faces, .label = true});
    ASSERT_EQ(cut.objects.size(), 2U);
    const CutObject &shell = cut.objects[0], &seed = cut.objects[1];
    EXPECT_EQ(shell.id, extent.index(4, 4, 0));
    EXPECT_EQ(shell.voxels, 98);
    EXPECT_DOUBLE_EQ(shell.measure, 98 * 3.0);
    EXPECT_EQ(shell.b1, 0);
    EXPECT_EQ(shell.b2, 1);
    EXPECT_EQ(shell.chi, 2);
    EXPECT_EQ(shell.box_low, (Index3{0, 0, 0}));
    EXPECT_EQ(shell.box_high, (Index3{4, 4, 4}));
    EXPECT_EQ(seed.id, extent.index(2, 2, 2));
    EXPECT_EQ(seed.box_low, (Index3{2, 2, 2}));
    EXPECT_EQ(seed.box_high, seed.box_low);
    EXPECT_EQ(seed.chi, 1);
    ASSERT_EQ(cut.contours.size(), 3U);
    EXPECT_EQ(cut.contours[0].id, shell.id);
    EXPECT_EQ(cut.contours[0].shell, Shell::outer);
    EXPECT_EQ(cut.contours[0].hits, 6 * 25);
    EXPECT_EQ(cut.contours[1].id, extent.index(3, 1, 2));  // two voxels of value 1: the smaller index
    EXPECT_EQ(cut.contours[1].object, shell.id);
    EXPECT_EQ(cut.contours[1].shell, Shell::inner);
    EXPECT_EQ(cut.contours[1].hits, 6 * 9);
    EXPECT_EQ(cut.contours[2].hits, 6);
    EXPECT_EQ(shell.first_contour, 0);
    EXPECT_EQ(shell.contour_count, 2);
    EXPECT_EQ(seed.first_contour, 2);
    EXPECT_EQ(cut.label[extent.index(0, 0, 0)], 0);
    EXPECT_EQ(cut.label[extent.index(2, 2, 2)], 1);
    EXPECT_EQ(cut.label[extent.index(1, 1, 1)], -1);
}

TEST(Cut, MeasureOfARectilinearGrid) {
    Volume volume = volume_of(3, {3, 1, 1}, {5, 5, 0});
    volume.info.geometry.coordinates[0] = {0, 1, 5};
    EXPECT_DOUBLE_EQ(cut(volume, 5).objects.at(0).measure, 1 + 2.5);
}

TEST(Cut, EqualSizesAreOrderedById) {
    const Cut cut = isoatlas::cut(volume_of(3, {7, 1, 1}, {3, 0, 9, 9, 0, 0, 4}), 2);
    ASSERT_EQ(cut.objects.size(), 3U);
    EXPECT_EQ(cut.objects[0].id, 3);  // the larger index of the two highest voxels
    EXPECT_EQ(cut.objects[1].id, 0);
    EXPECT_EQ(cut.objects[2].id, 6);
}

TEST(Cut, AboveTheMaximumAndBelowTheMinimum) {
    for (const double tau : {10.5, 255.0, 255.5, 1e9}) {
        const Cut none = cut(nested(), tau);
        EXPECT_TRUE(none.objects.empty() && none.contours.empty());
        EXPECT_EQ(none.active_cells, 0);
        EXPECT_TRUE(none.label.empty());
    }
    for (const double tau : {1.0, 0.5, 0.0, -1e9}) {
        const Cut box = cut(nested(), tau);
        ASSERT_EQ(box.objects.size(), 1U);
        EXPECT_EQ(box.objects[0].voxels, 125);
        EXPECT_EQ(box.active_cells, 6 * 6 * 6 - 4 * 4 * 4);
    }
}

// A ring with a hole; the diagonal 8 is joined to the ring through a face point (docs/theory/4-genus.md#objects: 2D counts holes).
TEST(Cut, AnImage) {
    const Volume image = volume_of(2, {5, 4, 1}, {9, 9, 9, 0, 0,  //
                                                  9, 0, 9, 0, 0,  //
                                                  9, 9, 9, 6, 0,  //
                                                  0, 0, 6, 8, 0});
    const Cut at_5 = cut(image, 5);
    ASSERT_EQ(at_5.objects.size(), 1U);
    EXPECT_EQ(at_5.objects[0].b1, 1);
    EXPECT_EQ(at_5.objects[0].b2, 0);
    EXPECT_EQ(at_5.objects[0].chi, 0);
    EXPECT_EQ(at_5.contours.size(), 2U);
    EXPECT_EQ(at_5.contours[1].id, 6);
    EXPECT_EQ(at_5.contours[1].hits, 4);
    EXPECT_EQ(at_5.contours[1].genus, 0);
    const double saddle = 7.2;  // a little more than (9 * 8 - 6 * 6) / (9 + 8 - 6 - 6), which is no double
    EXPECT_EQ(cut(image, saddle).objects.size(), 2U);
    EXPECT_EQ(cut(image, std::nextafter(saddle, 0)).objects.size(), 1U);
    EXPECT_EQ(cut(image, 7.5).objects.size(), 2U);
    EXPECT_EQ(cut(image, 8.5).objects.size(), 1U);
}

TEST(Cut, AnIsovalueMustBeFinite) {
    for (const double tau : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
        try {
            static_cast<void>(cut(nested(), tau));
            FAIL();
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::usage);
        }
    }
}

}  // namespace
}  // namespace isoatlas
