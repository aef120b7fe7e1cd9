// Volumes in memory and readers around functions give what files with the same samples do.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "isoatlas/volume.h"

namespace isoatlas {
namespace {

const Extent kExtent{.rank = 3, .size = {3, 2, 4}};
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

std::vector<float> with_gap() {
    std::vector<float> samples(24);
    for (std::size_t i = 0; i < samples.size(); ++i) samples[i] = static_cast<float>(i);
    samples[7] = kNaN;
    return samples;
}

Volume borrowed(const std::vector<float>& samples) {
    return borrow_volume(kExtent, ValueType::f32, std::as_bytes(std::span(samples)), nullptr);
}

std::unique_ptr<VolumeReader> reader_of(const Volume& volume) {
    const std::int64_t slice = volume.info.extent.slice() * static_cast<std::int64_t>(size_of(volume.info.type));
    return slab_reader(volume.info, [&volume, slice](std::int64_t begin, std::int64_t end, std::span<std::byte> out) {
        std::copy(volume.bytes.begin() + begin * slice, volume.bytes.begin() + end * slice, out.begin());
    });
}

TEST(SlabReaders, LoadWhatTheirFunctionReads) {
    std::vector<float> samples = with_gap();
    samples[7] = 7;
    const Volume volume = borrowed(samples);
    Context context;
    context.slab_slices = 1;
    EXPECT_EQ(load_volume(*reader_of(volume), {}, context).bytes, volume.bytes);
    EXPECT_TRUE(reader_of(volume)->info().slab_readable);
    VolumeInfo empty = volume.info;
    empty.extent.size[1] = 0;
    EXPECT_THROW((void)slab_reader(empty, [](std::int64_t, std::int64_t, std::span<std::byte>) {}), Error);
}

TEST(MissingSamples, OfAVolumeInMemoryAreThoseOfItsReader) {
    using Action = MissingPolicy::Action;
    const std::vector<float> samples = with_gap();
    const std::vector<MissingPolicy> policies{{.action = Action::below, .no_data = {}},
                                              {.action = Action::above, .no_data = {}},
                                              {.action = Action::replace, .value = 3, .no_data = {}},
                                              {.action = Action::replace, .value = 3, .no_data = 5.0}};
    for (const MissingPolicy& policy : policies) {
        Volume volume = borrowed(samples);
        const Volume loaded = load_volume(*reader_of(borrowed(samples)), policy);
        replace_missing(volume, policy);
        EXPECT_EQ(volume.bytes, loaded.bytes);
        EXPECT_EQ(volume.info.notes, loaded.info.notes);
        EXPECT_FALSE(volume.bytes.is_borrowed());
        EXPECT_TRUE(std::isnan(samples[7]));
    }
}

TEST(MissingSamples, AreNamedWhereThereIsNoPolicy) {
    const std::vector<float> samples = with_gap();
    Volume volume = borrowed(samples);
    try {
        replace_missing(volume);
        FAIL() << "there is a NaN";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::input);
        EXPECT_EQ(error.reason(), Reason::missing_samples);
        EXPECT_EQ(error.text().where, "voxel (1, 0, 1)");
    }
}

TEST(MissingSamples, ThatAreNotThereLeaveTheSamplesWhereTheyAre) {
    std::vector<float> samples = with_gap();
    samples[7] = 7;
    Volume volume = borrowed(samples);
    replace_missing(volume, {.action = MissingPolicy::Action::below, .no_data = {}});
    EXPECT_EQ(static_cast<const void*>(std::as_const(volume).bytes.data()), samples.data());
}

TEST(MissingSamples, AreFoundBehindANegativeCalibration) {
    std::vector<float> samples = with_gap();
    samples[7] = 7;
    Volume volume = borrowed(samples);
    volume.info.calibration = {.slope = -2, .intercept = 1};
    replace_missing(volume);
    EXPECT_EQ(volume.info.type, ValueType::f64);
    EXPECT_EQ(volume.value(3), -5);
    EXPECT_TRUE(volume.info.calibration.is_identity());
}

}  // namespace
}  // namespace isoatlas
