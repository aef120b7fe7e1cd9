// load_volume: slabs, progress, cancelling, missing samples, negative slopes.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "unit/formats/volume/volume_files.h"

namespace isoatlas {
namespace {

using test::expect_helpful;
using test::failure_of;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

template <class T>
std::string nrrd_of(const test::TestFolder& folder, const std::vector<T>& samples, const std::string& sizes, const std::string& more = "") {
    return folder.write("v.nrrd", "NRRD0004\ntype: " + std::string(name_of(value_type_of<T>)) + "\ndimension: 3\nsizes: " + sizes +
                                      "\nendian: little\nencoding: raw\n" + more + "\n" + test::bytes_of(samples));
}

template <class T>
std::vector<T> loaded(const std::string& path, const MissingPolicy& policy, std::int64_t slab_slices = 0) {
    Context context;
    context.slab_slices = slab_slices;
    const Volume volume = load_volume(path, {}, policy, context);
    EXPECT_EQ(volume.info.type, value_type_of<T>);
    const std::span<const T> samples = volume.samples<T>();
    return {samples.begin(), samples.end()};
}

MissingPolicy policy_of(MissingPolicy::Action action, double value = 0, std::optional<double> no_data = {}) {
    return {.action = action, .value = value, .no_data = no_data};
}
using enum MissingPolicy::Action;

TEST(LoadVolume, SlabsAndProgress) {
    const test::TestFolder folder;
    std::vector<std::uint16_t> samples(6 * 5 * 7);
    for (std::size_t i = 0; i < samples.size(); ++i) samples[i] = static_cast<std::uint16_t>(i * 311);
    const std::string path = nrrd_of(folder, samples, "6 5 7");
    for (std::int64_t slices = 0; slices <= 9; ++slices) {
        Context context;
        context.slab_slices = slices;
        std::vector<double> fractions;
        context.progress = [&](const Progress& progress) { fractions.push_back(progress.fraction); };
        const Volume volume = load_volume(path, {}, {}, context);
        EXPECT_EQ(test::text_of_bytes(volume), test::bytes_of(samples));
        EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
        EXPECT_EQ(fractions.front(), 0);
        EXPECT_EQ(fractions.back(), 1);
        if (slices > 0) {
            EXPECT_EQ(fractions.size(), static_cast<std::size_t>((7 + slices - 1) / slices + 1));
        }
    }
}

TEST(LoadVolume, Cancelling) {
    const test::TestFolder folder;
    const std::string path = nrrd_of(folder, std::vector<std::uint16_t>(64), "4 4 4");
    Context context;
    context.slab_slices = 1;
    int polls = 0;
    context.cancelled = [&] { return ++polls == 3; };
    const test::Failure failure = failure_of([&] { static_cast<void>(load_volume(path, {}, {}, context)); });
    EXPECT_EQ(static_cast<int>(failure.kind), static_cast<int>(ErrorKind::cancelled));
    EXPECT_EQ(polls, 3);
}

TEST(LoadVolume, FirstMissingVoxelIsNamed) {
    const test::TestFolder folder;
    const std::vector<std::pair<float, std::string>> bad = {{kNan, "nan"}, {kInfinity, "inf"}, {-kInfinity, "-inf"}};
    for (const auto& [value, name] : bad) {
        for (std::size_t at = 0; at < 24; ++at) {
            std::vector<float> samples(24, 1.5F);
            samples[at] = value;
            samples[23] = value;
            const std::string path = nrrd_of(folder, samples, "2 3 4");
            for (const std::int64_t slices : {1, 3, 0}) {
                Context context;
                context.slab_slices = slices;
                const test::Failure failure = failure_of([&] { static_cast<void>(load_volume(path, {}, {}, context)); });
                const std::string voxel =
                    "voxel (" + std::to_string(at % 2) + ", " + std::to_string(at / 2 % 3) + ", " + std::to_string(at / 6) + ")";
                expect_helpful(failure, ErrorKind::input, voxel + ": the sample is " + name + " (");
                expect_reason(failure, ErrorKind::input, Reason::missing_samples);
            }
        }
    }
}

TEST(LoadVolume, MissingSamplesAreReplaced) {
    const test::TestFolder folder;
    const std::vector<float> samples = {kNan, 3, -0.0F, kInfinity, -2.5F, -kInfinity, 1e20F, 7};
    const std::string path = nrrd_of(folder, samples, "2 2 2");
    for (const std::int64_t slices : {1, 2}) {
        EXPECT_EQ(loaded<float>(path, policy_of(replace, 9), slices), (std::vector<float>{9, 3, 0, 9, -2.5F, 9, 1e20F, 7}));
        const float below_all = std::nextafter(-2.5F, -kInfinity);
        const std::vector<float> result = loaded<float>(path, policy_of(below, 0, 1e20), slices);
        EXPECT_EQ(result, (std::vector<float>{below_all, 3, 0, below_all, -2.5F, below_all, below_all, 7}));
        EXPECT_TRUE(std::signbit(result[2]));  // -0.0 stays what it is
    }
    const Volume volume = load_volume(path, {}, policy_of(below));
    ASSERT_EQ(volume.info.notes.size(), 1U);
    EXPECT_NE(volume.info.notes[0].find("3 missing samples were replaced by -2.50000"), std::string::npos) << volume.info.notes[0];
    EXPECT_EQ(loaded<double>(nrrd_of(folder, std::vector<double>{0, std::nan("")}, "2 1 1"), policy_of(below)),
              (std::vector<double>{0, -std::numeric_limits<double>::denorm_min()}));
}

TEST(LoadVolume, NoDataOfIntegers) {
    const test::TestFolder folder;
    const std::string path = nrrd_of(folder, std::vector<std::int16_t>{-32768, 5, 3, -32768}, "2 2 1");
    EXPECT_EQ(loaded<std::int16_t>(path, {}), (std::vector<std::int16_t>{-32768, 5, 3, -32768}));
    EXPECT_EQ(loaded<std::int16_t>(path, policy_of(below, 0, -32768)), (std::vector<std::int16_t>{2, 5, 3, 2}));
    EXPECT_EQ(loaded<std::int16_t>(path, policy_of(replace, -7, -32768)), (std::vector<std::int16_t>{-7, 5, 3, -7}));
    EXPECT_EQ(loaded<std::int16_t>(path, policy_of(replace, -7, 99)), (std::vector<std::int16_t>{-32768, 5, 3, -32768}));
    const auto failing = [&](const MissingPolicy& policy) { return failure_of([&] { static_cast<void>(load_volume(path, {}, policy)); }); };
    expect_helpful(failing(policy_of(error, 0, 3)), ErrorKind::input, "voxel (0, 1, 0): the sample is 3, the no-data value");
    expect_helpful(failing(policy_of(below, 0, 3)), ErrorKind::input, "no int16 lies below");
    expect_helpful(failing(policy_of(replace, 0.5, 3)), ErrorKind::usage, "0.5 is not a value of int16");
    expect_helpful(failing(policy_of(replace, 32768, 3)), ErrorKind::usage, "32768");
    expect_helpful(failing(policy_of(replace, std::nan(""), 3)), ErrorKind::usage, "nan");
}

TEST(LoadVolume, NothingFinite) {
    const test::TestFolder folder;
    const std::string path = nrrd_of(folder, std::vector<float>(8, kNan), "2 2 2");
    expect_helpful(failure_of([&] { static_cast<void>(load_volume(path, {}, policy_of(below))); }), ErrorKind::input,
                   "every sample is missing");
    EXPECT_EQ(loaded<float>(path, policy_of(replace, 4)), std::vector<float>(8, 4));
    const std::string lowest = nrrd_of(folder, std::vector<float>{std::numeric_limits<float>::lowest(), kNan}, "2 1 1");
    expect_helpful(failure_of([&] { static_cast<void>(load_volume(lowest, {}, policy_of(below))); }), ErrorKind::input, "lies below");
    expect_helpful(failure_of([&] { static_cast<void>(load_volume(lowest, {}, policy_of(replace, 1e300))); }), ErrorKind::usage, "1e+300");
    const std::string highest = nrrd_of(folder, std::vector<float>{std::numeric_limits<float>::max(), kNan}, "2 1 1");
    EXPECT_EQ(loaded<float>(highest, policy_of(below))[1], std::nextafter(std::numeric_limits<float>::max(), 0.0F));
}

TEST(LoadVolume, NegativeSlope) {
    const test::TestFolder folder;
    const std::string slope = "calibration_slope:=-2\ncalibration_intercept:=10\n";
    const std::string path = nrrd_of(folder, std::vector<std::int16_t>{-1, 0, 5, -32768}, "2 2 1", slope);
    for (const std::int64_t slices : {0, 1}) {
        EXPECT_EQ(loaded<double>(path, {}, slices), (std::vector<double>{12, 10, 0, 65546}));
        EXPECT_EQ(loaded<double>(path, policy_of(replace, 4, -32768), slices), (std::vector<double>{12, 10, 0, 2}));
        EXPECT_EQ(loaded<double>(path, policy_of(below, 0, -32768), slices),
                  (std::vector<double>{12, 10, 0, -std::numeric_limits<double>::denorm_min()}));
    }
    const Volume volume = load_volume(path);
    EXPECT_TRUE(volume.info.calibration.is_identity());
    ASSERT_EQ(volume.info.notes.size(), 1U);
    EXPECT_NE(volume.info.notes[0].find("slope is negative"), std::string::npos);
    const std::string floats = nrrd_of(folder, std::vector<float>{1, kInfinity, 2, kNan}, "2 2 1", slope);
    expect_helpful(failure_of([&] { static_cast<void>(load_volume(floats)); }), ErrorKind::input, "voxel (1, 0, 0)");
    EXPECT_EQ(loaded<double>(floats, policy_of(replace, 3)), (std::vector<double>{8, 4, 6, 4}));
    const Volume positive = load_volume(nrrd_of(folder, std::vector<std::int16_t>{1, 2}, "2 1 1", "calibration_slope:=2\n"));
    EXPECT_EQ(positive.info.type, ValueType::i16);
    EXPECT_EQ(positive.info.calibration, (Calibration{2, 0}));
}

}  // namespace
}  // namespace isoatlas
