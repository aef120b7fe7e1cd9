// Samples that a store gives to those who look at them, against those it was made of.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <filesystem>

#include "isoatlas/output.h"
#include "oracle/stores.h"

namespace oracle {
namespace {

using isoatlas::Extent;
using isoatlas::Volume;

RC_GTEST_FIXTURE_PROP(Stores, GiveEveryStepthSampleOfABox, ()) {
    const Grid grid = arbitrary_volume();
    const Volume volume = to_volume(grid, arbitrary_type(grid));
    isoatlas::build_atlas(path_, volume);
    const isoatlas::Atlas atlas(path_);
    const Extent& extent = volume.info.extent;
    isoatlas::SampleBox box{};
    for (int a = 0; a < 3; ++a) {
        box.begin[a] = *rc::gen::inRange<Index>(0, extent.size[a]);
        box.end[a] = *rc::gen::inRange<Index>(box.begin[a] + 1, extent.size[a] + 1);
    }
    const Index step = *rc::gen::inRange<Index>(1, 20);
    const Volume part = atlas.samples(box, step);
    for (int a = 0; a < 3; ++a) RC_ASSERT(part.info.extent.size[a] == (box.end[a] - box.begin[a] + step - 1) / step);
    for (Index i = 0; i < part.info.extent.voxels(); ++i) {
        const isoatlas::Index3 at = part.info.extent.voxel(i);
        const auto whole = [&](int a) { return box.begin[a] + step * at[a]; };
        RC_ASSERT(part.value(i) == volume.value(extent.index(whole(0), whole(1), whole(2))));
    }
}

RC_GTEST_FIXTURE_PROP(Stores, GiveTheMeansOfCubes, ()) {
    const Grid grid = arbitrary_volume();
    const Volume volume = to_volume(grid, arbitrary_type(grid));
    isoatlas::build_atlas(path_, volume);
    const isoatlas::Atlas atlas(path_);
    const Extent& extent = volume.info.extent;
    const Index max = *rc::gen::inRange<Index>(1, extent.voxels() + 2);
    const isoatlas::CoarseVolume coarse = atlas.coarse(max);
    RC_ASSERT(coarse.extent.voxels() <= max);
    RC_ASSERT(static_cast<Index>(coarse.mean.size()) == coarse.extent.voxels());
    if (coarse.step > 8) return;  // means of means: at the far ends of fewer samples
    for (Index i = 0; i < coarse.extent.voxels(); ++i) {
        const isoatlas::Index3 at = coarse.extent.voxel(i);
        double sum = 0, count = 0;
        for (Index v = 0; v < coarse.step * coarse.step * coarse.step; ++v) {
            std::array<Index, 3> sample{v % coarse.step, v / coarse.step % coarse.step, v / (coarse.step * coarse.step)};
            for (int a = 0; a < 3; ++a) sample[a] += coarse.step * at[a];
            if (sample[0] >= extent.size[0] || sample[1] >= extent.size[1] || sample[2] >= extent.size[2]) continue;
            sum += volume.value(extent.index(sample[0], sample[1], sample[2]));
            ++count;
        }
        RC_ASSERT(static_cast<double>(coarse.mean[i]) == static_cast<double>(static_cast<float>(sum / count)));
    }
}

RC_GTEST_FIXTURE_PROP(Stores, DescribeTheirVolume, ()) {
    const Grid grid = arbitrary_volume();
    Volume volume = to_volume(grid, arbitrary_type(grid));
    isoatlas::build_atlas(path_, volume);
    const isoatlas::Atlas atlas(path_);
    const std::string file = path_ + ".nrrd";
    const auto is_known = [&] {
        isoatlas::write_volume(file, volume);
        return atlas.is_of(*isoatlas::open_volume(file));
    };
    RC_ASSERT(is_known());
    const auto byte = static_cast<std::size_t>(*rc::gen::inRange<Index>(0, static_cast<Index>(volume.bytes.size())));
    volume.bytes[byte] ^= std::byte{1};
    RC_ASSERT(!is_known());
    std::filesystem::remove(file);
}

TEST_F(Stores, RejectBoxesThatReachOutside) {
    isoatlas::build_atlas(path_, isoatlas::make_volume({.rank = 3, .size = {20, 9, 9}}, isoatlas::ValueType::f32));
    const isoatlas::Atlas atlas(path_);
    for (const isoatlas::SampleBox& box : {isoatlas::SampleBox{{0, 0, 0}, {0, 9, 9}}, {{-1, 0, 0}, {1, 1, 1}}, {{0, 0, 0}, {20, 9, 10}}})
        EXPECT_THROW((void)atlas.samples(box), isoatlas::Error);
    EXPECT_THROW((void)atlas.samples({{0, 0, 0}, {1, 1, 1}}, 0), isoatlas::Error);
    EXPECT_THROW((void)atlas.coarse(0), isoatlas::Error);
    const std::int64_t before = atlas.reads().bricks;
    EXPECT_EQ(atlas.samples({{17, 0, 0}, {18, 9, 9}}).info.extent.voxels(), 81);
    EXPECT_EQ(atlas.reads().bricks - before, 4) << "bricks that the slice does not pass were read";
    const isoatlas::Volume placed = atlas.samples({{4, 2, 0}, {20, 9, 9}}, 3);
    EXPECT_EQ(isoatlas::to_physical(placed.info.geometry, {1, 1, 1}), (isoatlas::Vec3{7, 5, 3}));
}

}  // namespace
}  // namespace oracle
