// Every NRRD, MetaImage and NumPy file of the shared data reads bit-exactly: SHA-256 of the samples against stats.json, whole and in slabs.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "oracle/sha256.h"
#include "unit/formats/volume/volume_files.h"

namespace isoatlas {
namespace {

const std::string kSharedData = std::string(ISOATLAS_SOURCE_DIR) + "/../shared/data/";

nlohmann::json read_stats() {
    std::ifstream file(kSharedData + "stats.json");
    return file ? nlohmann::json::parse(file) : nlohmann::json();
}

/// Samples of all time steps, read `slices` slices at a time.
std::string checksum(const std::string& path, std::int64_t steps, std::int64_t slices) {
    oracle::Sha256 sum;
    for (std::int64_t step = 0; step < steps; ++step) {
        OpenOptions options;
        if (steps > 1) options.time_step = step;
        const std::unique_ptr<VolumeReader> reader = open_volume(path, options);
        const std::string bytes = test::read_all(*reader, slices);
        sum.add(std::as_bytes(std::span(bytes)));
    }
    return sum.hex();
}

TEST(SharedData, EverySampleIsTheRightOne) {
    const nlohmann::json stats = read_stats();
    if (stats.empty()) GTEST_SKIP() << "no shared data";
    int files = 0;
    for (const auto& [name, facts] : stats.items()) {
        if (facts.value("kind", "") != "grid" || !(name.ends_with(".nrrd") || name.ends_with(".mha"))) continue;
        SCOPED_TRACE(name);
        const std::vector<std::int64_t> dims = facts.at("dims");
        const std::int64_t steps = dims.size() == 4 ? dims[3] : 1;
        EXPECT_EQ(checksum(kSharedData + name, steps, 1 << 20), facts.at("sha256_samples").get<std::string>());
        EXPECT_EQ(checksum(kSharedData + name, steps, 7), facts.at("sha256_samples").get<std::string>());
        OpenOptions options;
        if (steps > 1) options.time_step = 0;
        const std::unique_ptr<VolumeReader> reader = open_volume(kSharedData + name, options);
        const VolumeInfo& info = reader->info();
        EXPECT_EQ(info.extent.rank, static_cast<int>(std::min<std::size_t>(3, dims.size())));
        EXPECT_EQ(name_of(info.type), facts.at("dtype"));
        const std::vector<double> spacing = facts.at("spacing");
        for (int axis = 0; axis < info.extent.rank; ++axis) {
            EXPECT_EQ(info.extent.size[axis], dims[static_cast<std::size_t>(axis)]);
            EXPECT_NEAR(info.geometry.spacing[axis], spacing[static_cast<std::size_t>(axis)], 1e-6);
        }
        ++files;
    }
    EXPECT_GE(files, 40);
}

/// Originals in other encodings (big endian, detached, zlib, .npy) hold the same samples as the converted file.
TEST(SharedData, OriginalsEqualTheConvertedFiles) {
    const nlohmann::json stats = read_stats();
    if (stats.empty()) GTEST_SKIP() << "no shared data";
    const std::vector<std::pair<std::string, std::string>> pairs = {
        {"tooth/original/tooth.nhdr", "tooth/tooth.nrrd"},
        {"frog_labels/original/frogtissue.mhd", "frog_labels/frog_labels.nrrd"},
        {"lung_ct/original/3DCT_lung_baseline_small.mha", "lung_ct/lung_lo.nrrd"},
        {"dens40/original/dens40.npy", "dens40/dens40.nrrd"},
        {"avf/original/avf_float_32.nrrd", "avf/avf.nrrd"}};
    for (const auto& [original, converted] : pairs) {
        SCOPED_TRACE(original);
        const auto whole = open_volume(kSharedData + original), other = open_volume(kData + converted);
        EXPECT_EQ(whole->info().extent, other->info().extent);
        EXPECT_EQ(whole->info().type, other->info().type);
    }
    EXPECT_EQ(checksum(kSharedData + "tooth/original/tooth.nhdr", 1, 5),
              stats.at("tooth/tooth.nrrd").at("sha256_samples").get<std::string>());
    EXPECT_EQ(checksum(kSharedData + "lung_ct/original/3DCT_lung_baseline_small.mha", 1, 9),
              stats.at("lung_ct/lung_lo.nrrd").at("sha256_samples").get<std::string>());
    EXPECT_EQ(checksum(kSharedData + "dens40/original/dens40.npy", 1, 9),
              stats.at("dens40/dens40.nrrd").at("sha256_samples").get<std::string>());
}

/// frogtissue.mhd claims a CompressedDataSize that is too small. The converted file was made by a reader that stops there and has zeros
/// in the last 5 slices; the stream itself is whole (its checksum is right), and all of it is read, with a note.
TEST(SharedData, TooSmallCompressedDataSizeLosesNothing) {
    const std::string original = kSharedData + "frog_labels/original/frogtissue.mhd";
    if (!std::filesystem::exists(original)) GTEST_SKIP() << "no shared data";
    const auto reader = open_volume(original);
    const std::string whole = test::read_all(*reader, 9);
    const std::string converted = test::read_all(*open_volume(kSharedData + "frog_labels/frog_labels.nrrd"), 136);
    constexpr std::size_t kCut = 30963285;  // what zlib makes of the first 260020 bytes
    EXPECT_EQ(whole.substr(0, kCut), converted.substr(0, kCut));
    EXPECT_NE(whole.find_first_not_of('\0', kCut), std::string::npos);
    EXPECT_EQ(converted.find_first_not_of('\0', kCut), std::string::npos);
    ASSERT_EQ(reader->info().notes.size(), 1U);
    EXPECT_NE(reader->info().notes[0].find("CompressedDataSize is 260020"), std::string::npos);
}

TEST(SharedData, CalibrationAndGeometryAreRead) {
    if (!std::filesystem::exists(kSharedData + "stats.json")) GTEST_SKIP() << "no shared data";
    const auto pet = open_volume(kSharedData + "pet/pet.nrrd");
    EXPECT_EQ(pet->info().calibration, (Calibration{2.0222414, 0}));
    const auto lung = open_volume(kSharedData + "lung_ct/lung_lo.nrrd");
    EXPECT_EQ(lung->info().geometry.origin, (Vec3{-152.461, -148.986, -1432}));
    const auto avf = open_volume(kSharedData + "avf/original/avf_float_32.nrrd");
    EXPECT_EQ(avf->info().geometry.space, "LPS");
    EXPECT_EQ(avf->info().geometry.direction, (Mat3{{{-1, 0, 0}, {0, -1, 0}, {0, 0, 1}}}));
    EXPECT_EQ(avf->info().geometry.spacing, (Vec3{0.7226560115814209, 0.7226560115814209, 1}));
}

TEST(SharedData, NegativeSlopeIsApplied) {
    if (!std::filesystem::exists(kSharedData + "stats.json")) GTEST_SKIP() << "no shared data";
    OpenOptions options;
    options.time_step = 1;
    const auto reader = open_volume(kSharedData + "era_z/era_z.nrrd", options);
    const Volume volume = load_volume(*reader);
    ASSERT_EQ(volume.info.type, ValueType::f64);
    EXPECT_TRUE(volume.info.calibration.is_identity());
    const std::string stored = test::read_all(*reader, 1);
    for (std::size_t i = 0; i < volume.samples<double>().size(); i += 997) {
        std::int16_t sample = 0;
        std::memcpy(&sample, stored.data() + 2 * i, 2);
        ASSERT_EQ(volume.samples<double>()[i], -1.7250274674967954 * sample + 66825.5);
    }
}

}  // namespace
}  // namespace isoatlas
