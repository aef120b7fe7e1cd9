// NIfTI: types, byte orders, versions, pairs, geometry, calibration, time steps, damage, and the files of the shared data.
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "oracle/sha256.h"
#include "unit/formats/volume/bzip2_stream.h"
#include "unit/formats/volume/hostile_files.h"
#include "unit/formats/volume/volume_files.h"

namespace isoatlas {
namespace {

using namespace test;

/// A header under construction: fields by byte offset, swapped at the end.
class NiftiFile {
public:
    explicit NiftiFile(int version = 1, bool big_endian = false)
        : version_(version), big_(big_endian), bytes_(version == 1 ? 352 : 544, '\0') {
        set<std::int32_t>(0, version == 1 ? 348 : 540);
        if (version == 1) {
            bytes_.replace(344, 4, std::string("n+1\0", 4));
            set<float>(108, 352);
        } else {
            bytes_.replace(4, 8, std::string("n+2\0\r\n\032\n", 8));
            set<std::int64_t>(168, 544);
        }
        dims({3, 4, 3, 2});
        type(4, 16);
        for (int i = 0; i < 8; ++i) pixdim(i, 1);
    }
    NiftiFile& dims(const std::vector<std::int64_t>& sizes) {  // dim[0] first
        for (std::size_t i = 0; i < sizes.size(); ++i) {
            if (version_ == 1)
                set<std::int16_t>(40 + 2 * i, static_cast<std::int16_t>(sizes[i]));
            else
                set<std::int64_t>(16 + 8 * i, sizes[i]);
        }
        return *this;
    }
    NiftiFile& type(int code, int bits) {
        set<std::int16_t>(version_ == 1 ? 70 : 12, static_cast<std::int16_t>(code));
        return set<std::int16_t>(version_ == 1 ? 72 : 14, static_cast<std::int16_t>(bits));
    }
    NiftiFile& pixdim(int i, double value) { return real(version_ == 1 ? 76 + 4 * i : 104 + 8 * i, value); }
    NiftiFile& offset(double value) {
        return version_ == 1 ? set<float>(108, static_cast<float>(value)) : set<std::int64_t>(168, static_cast<std::int64_t>(value));
    }
    NiftiFile& scale(double slope, double intercept) {
        return real(version_ == 1 ? 112 : 176, slope).real(version_ == 1 ? 116 : 184, intercept);
    }
    NiftiFile& units(int code) {
        return version_ == 1 ? set<std::uint8_t>(123, static_cast<std::uint8_t>(code)) : set<std::int32_t>(500, code);
    }
    NiftiFile& codes(int qform, int sform) {
        if (version_ == 1)
            return set<std::int16_t>(252, static_cast<std::int16_t>(qform)).set<std::int16_t>(254, static_cast<std::int16_t>(sform));
        return set<std::int32_t>(344, qform).set<std::int32_t>(348, sform);
    }
    NiftiFile& qform(std::array<double, 3> quaternion, std::array<double, 3> at) {
        for (int i = 0; i < 3; ++i) {
            real(version_ == 1 ? 256 + 4 * i : 352 + 8 * i, quaternion[static_cast<std::size_t>(i)]);
            real(version_ == 1 ? 268 + 4 * i : 376 + 8 * i, at[static_cast<std::size_t>(i)]);
        }
        return *this;
    }
    NiftiFile& sform(const std::array<double, 12>& rows) {
        for (int i = 0; i < 12; ++i) real(version_ == 1 ? 280 + 4 * i : 400 + 8 * i, rows[static_cast<std::size_t>(i)]);
        return *this;
    }
    NiftiFile& text(const std::string& description) {
        bytes_.replace(version_ == 1 ? 148 : 240, description.size(), description);
        return *this;
    }
    NiftiFile& magic(const std::string& text) {
        bytes_.replace(version_ == 1 ? 344 : 4, text.size(), text);
        return *this;
    }
    template <class T>
    NiftiFile& set(std::size_t at, T value) {
        std::string raw(reinterpret_cast<const char*>(&value), sizeof value);
        if (big_) std::reverse(raw.begin(), raw.end());
        bytes_.replace(at, raw.size(), raw);
        return *this;
    }
    [[nodiscard]] std::string header() const { return bytes_; }
    [[nodiscard]] std::string with(const std::string& little_samples, std::size_t sample_bytes = 2) const {
        return bytes_ + (big_ ? swapped(little_samples, sample_bytes) : little_samples);
    }

private:
    NiftiFile& real(int at, double value) {
        return version_ == 1 ? set<float>(static_cast<std::size_t>(at), static_cast<float>(value))
                             : set<double>(static_cast<std::size_t>(at), value);
    }
    int version_;
    bool big_;
    std::string bytes_;
};

struct TypeCase {
    int code;
    ValueType type;
};
constexpr TypeCase kTypes[] = {{2, ValueType::u8},  {256, ValueType::i8},  {4, ValueType::i16},  {512, ValueType::u16},
                               {8, ValueType::i32}, {768, ValueType::u32}, {16, ValueType::f32}, {64, ValueType::f64}};

TEST(Nifti, EveryTypeByteOrderAndVersion) {
    const TestFolder folder;
    for (const TypeCase& c : kTypes) {
        for (const int version : {1, 2}) {
            for (const bool big : {false, true}) {
                const std::size_t sample = size_of(c.type);
                const std::string samples = telling_bytes(24 * sample);
                const std::string content = NiftiFile(version, big).type(c.code, static_cast<int>(8 * sample)).with(samples, sample);
                for (const bool packed : {false, true}) {
                    const std::string path = folder.write(packed ? "v.nii.gz" : "v.nii", packed ? gzip(content) : content);
                    const auto reader = open_volume(path);
                    EXPECT_EQ(reader->info().type, c.type);
                    EXPECT_EQ(reader->info().format, version == 1 ? "NIfTI-1" : "NIfTI-2");
                    EXPECT_EQ(reader->info().extent, (Extent{.rank = 3, .size = {4, 3, 2}}));
                    EXPECT_EQ(reader->info().slab_readable, !packed);
                    EXPECT_EQ(reader->info().big_endian, big);
                    EXPECT_EQ(read_all(*reader, 2), samples);
                    expect_slabs_equal_whole(path);
                }
            }
        }
    }
}

TEST(Nifti, DimensionsAndRank) {
    const TestFolder folder;
    const auto extent = [&](const std::vector<std::int64_t>& dims, std::size_t voxels) {
        return open_volume(folder.write("v.nii", NiftiFile().dims(dims).with(telling_bytes(2 * voxels))))->info().extent;
    };
    EXPECT_EQ(extent({2, 4, 3, 9, 9}, 12), (Extent{.rank = 2, .size = {4, 3, 1}}));
    EXPECT_EQ(extent({3, 4, 3, 1}, 12), (Extent{.rank = 3, .size = {4, 3, 1}}));
    EXPECT_EQ(extent({4, 4, 3, 2, 1}, 24), (Extent{.rank = 3, .size = {4, 3, 2}}));
    EXPECT_EQ(extent({7, 4, 3, 2, 1, 1, 1, 1}, 24), (Extent{.rank = 3, .size = {4, 3, 2}}));
}

TEST(Nifti, TimeSteps) {
    const TestFolder folder;
    const std::string samples = telling_bytes(2 * 24 * 3);
    const std::string content = NiftiFile().dims({4, 4, 3, 2, 3}).with(samples);
    for (const std::string& path : {folder.write("v.nii", content), folder.write("v.nii.gz", gzip(content))}) {
        expect_reason(failure_of_loading(path), ErrorKind::usage, Reason::time_step_needed, "2");
        for (std::int64_t step = 0; step < 3; ++step) {
            OpenOptions options;
            options.time_step = step;
            EXPECT_EQ(read_all(*open_volume(path, options), 1), samples.substr(static_cast<std::size_t>(step) * 48, 48));
            expect_slabs_equal_whole(path, options);
        }
        OpenOptions beyond;
        beyond.time_step = 3;
        expect_helpful(failure_of_loading(path, beyond), ErrorKind::usage, "time step 3");
    }
}

TEST(Nifti, SformBeforeQformBeforePixdim) {
    const TestFolder folder;
    const std::string samples = telling_bytes(48);
    NiftiFile file;
    file.pixdim(0, -1).pixdim(1, 2).pixdim(2, 3).pixdim(3, 4).units(2);
    const auto geometry = [&] { return open_volume(folder.write("v.nii", file.with(samples)))->info().geometry; };
    EXPECT_EQ(geometry(), (Geometry{.spacing = {2, 3, 4}, .space = "unknown", .unit = "mm"}));
    file.codes(1, 0).qform({0, 0, 1}, {10, 20, 30}).units(3);  // half a turn about z; the third axis is mirrored
    EXPECT_EQ(geometry(), (Geometry{.spacing = {2, 3, 4},
                                    .origin = {10, 20, 30},
                                    .direction = {{{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}}},
                                    .space = "RAS",
                                    .unit = "\u00b5m"}));
    file.codes(1, 2).sform({0, 0, 5, -1, 0.5, 0, 0, -2, 0, 0.25, 0, -3}).units(1);
    EXPECT_EQ(geometry(), (Geometry{.spacing = {0.5, 0.25, 5},
                                    .origin = {-1, -2, -3},
                                    .direction = {{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}},
                                    .space = "RAS",
                                    .unit = "m"}));
}

TEST(Nifti, OddGeometriesAreNoted) {
    const TestFolder folder;
    const auto info = [&](const NiftiFile& file) { return open_volume(folder.write("v.nii", file.with(telling_bytes(48))))->info(); };
    const auto has_note = [](const VolumeInfo& i, const std::string& words) {
        return std::any_of(i.notes.begin(), i.notes.end(), [&](const std::string& note) { return note.find(words) != std::string::npos; });
    };
    const VolumeInfo sheared = info(NiftiFile().codes(0, 1).sform({1, 1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}));
    EXPECT_TRUE(has_note(sheared, "sheared"));
    EXPECT_NEAR(sheared.geometry.spacing[1], std::sqrt(2), 1e-12);
    const VolumeInfo singular = info(NiftiFile().codes(1, 1).pixdim(1, 7).sform({1, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0}));
    EXPECT_TRUE(has_note(singular, "singular"));
    EXPECT_EQ(singular.geometry.spacing[0], 7);
    EXPECT_TRUE(has_note(info(NiftiFile().codes(1, 1).sform({2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0})), "differ"));
    EXPECT_FALSE(has_note(info(NiftiFile().codes(1, 1).sform({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0})), "differ"));
    EXPECT_TRUE(has_note(info(NiftiFile()), "orientation"));
    EXPECT_TRUE(has_note(info(NiftiFile().pixdim(2, 0)), "voxel size"));
    EXPECT_TRUE(has_note(info(NiftiFile().offset(0)), "where the samples start"));
}

TEST(Nifti, CalibrationAndDescription) {
    const TestFolder folder;
    const auto info = [&](NiftiFile file) {
        return open_volume(folder.write("v.nii", file.text("made by hand").with(telling_bytes(48))))->info();
    };
    EXPECT_EQ(info(NiftiFile().scale(0, 5)).calibration, Calibration{});
    EXPECT_EQ(info(NiftiFile().scale(1, 0)).calibration, Calibration{});
    EXPECT_EQ(info(NiftiFile().scale(0.5, -3)).calibration, (Calibration{0.5, -3}));
    EXPECT_EQ(info(NiftiFile(2).scale(0.1, -3)).calibration, (Calibration{0.1, -3}));
    EXPECT_EQ(info(NiftiFile().scale(std::nan(""), 3)).calibration, Calibration{});
    EXPECT_EQ(info(NiftiFile()).description, "made by hand");
}

TEST(Nifti, Pairs) {
    const TestFolder folder;
    const std::string samples = telling_bytes(48), header = NiftiFile().magic("ni1").offset(0).header().substr(0, 348);
    folder.write("a.hdr", header);
    folder.write("a.img", samples);
    folder.write("B.HDR", header);
    folder.write("B.IMG", samples);
    folder.write("c.hdr.gz", gzip(header));
    folder.write("c.img.gz", gzip(samples));
    folder.write("d.hdr", header);
    folder.write("d.img.gz", gzip(samples));
    folder.write("e.hdr.gz", gzip(header));
    folder.write("e.img.bz2", test::bzip2(samples));
    for (const char* name : {"a.hdr", "a.img", "B.HDR", "B.IMG", "c.hdr.gz", "c.img.gz", "d.hdr", "d.img.gz", "e.hdr.gz", "e.img.bz2"}) {
        SCOPED_TRACE(name);
        EXPECT_EQ(read_all(*open_volume(folder / name), 2), samples);
    }
    EXPECT_EQ(open_volume(folder / "a.hdr")->info().data_file, folder / "a.img");
    folder.write("alone.hdr", header);
    expect_helpful(failure_of_loading(folder / "alone.hdr"), ErrorKind::input, "alone.img");
    folder.write("shifted.hdr", NiftiFile().magic("ni1").offset(16).header().substr(0, 348));
    folder.write("shifted.img", std::string(16, 'x') + samples);
    EXPECT_EQ(read_all(*open_volume(folder / "shifted.hdr"), 2), samples);
    folder.write("odd.nii", header + samples);
    expect_helpful(failure_of_loading(folder / "odd.nii"), ErrorKind::input, "second file");
}

TEST(Nifti, WhatIsNotRead) {
    const TestFolder folder;
    const auto failure = [&](const NiftiFile& file) { return failure_of_loading(folder.write("v.nii", file.with(telling_bytes(4800)))); };
    expect_helpful(failure(NiftiFile().type(128, 24)), ErrorKind::unsupported, "RGB");
    expect_helpful(failure(NiftiFile().type(1024, 32)), ErrorKind::input, "bitpix");
    expect_helpful(failure(NiftiFile().type(32, 64)), ErrorKind::unsupported, "complex");
    expect_helpful(failure(NiftiFile().type(3, 16)), ErrorKind::input, "datatype");
    expect_helpful(failure(NiftiFile().type(4, 32)), ErrorKind::input, "bitpix");
    expect_helpful(failure(NiftiFile().dims({0, 4, 3, 2})), ErrorKind::input, "dim[0]");
    expect_helpful(failure(NiftiFile().dims({8, 4, 3, 2})), ErrorKind::input, "dim[0]");
    expect_helpful(failure(NiftiFile().dims({3, 4, -3, 2})), ErrorKind::input, "dim[2]");
    expect_helpful(failure(NiftiFile().dims({1, 4, 1, 1})), ErrorKind::unsupported, "one dimension");
    expect_helpful(failure(NiftiFile().dims({5, 4, 3, 2, 1, 3})), ErrorKind::unsupported, "dimension 5");
    expect_helpful(failure(NiftiFile().offset(100)), ErrorKind::input, "inside the header");
    expect_helpful(failure(NiftiFile().offset(-1)), ErrorKind::input, "vox_offset");
    expect_helpful(failure(NiftiFile().dims({3, 32767, 32767, 32767})), ErrorKind::input, "bytes");
    expect_helpful(failure(NiftiFile(2).dims({3, std::int64_t{1} << 40, std::int64_t{1} << 40, 1})), ErrorKind::input, "63 bits");
    expect_helpful(failure_of_loading(folder.write("no.nii", "this is no volume")), ErrorKind::input, "header");
}

TEST(Nifti, AnalyzePairs) {
    const test::TestFolder folder;
    for (const bool big : {false, true}) {
        SCOPED_TRACE(big ? "big" : "little");
        NiftiFile file(1, big);
        file.magic(std::string(4, '\0')).offset(0).pixdim(1, 0.5).pixdim(2, 0.7).pixdim(3, 2).codes(7, 9).scale(0, 3);
        const std::string samples = telling_bytes(48);
        const std::string path = folder.write("old.hdr", file.header().substr(0, 348));
        const std::string image = folder.write("old.img", file.with(samples).substr(352));
        for (const std::string& name : {path, image}) {
            const Volume volume = load_volume(name);
            EXPECT_EQ(volume.info.format, "ANALYZE 7.5");
            EXPECT_EQ(volume.info.geometry.spacing, (Vec3{0.5F, 0.7F, 2}));
            EXPECT_EQ(volume.info.geometry.space, "unknown");
            EXPECT_TRUE(volume.info.calibration.is_identity());
            EXPECT_EQ(std::string(reinterpret_cast<const char*>(volume.bytes.data()), volume.bytes.size()), samples);
        }
        folder.write("old.hdr", file.scale(2, 3).header().substr(0, 348));
        EXPECT_EQ(load_volume(path).info.calibration.slope, 2);
        EXPECT_EQ(load_volume(path).info.calibration.intercept, 0);
    }
    folder.write("alone.hdr", NiftiFile().magic(std::string(4, '\0')).header().substr(0, 348));
    expect_helpful(failure_of_loading(folder / "alone.hdr"), ErrorKind::input, "alone.img");
    expect_helpful(failure_of_loading(folder.write("short.hdr", NiftiFile().magic(std::string(4, '\0')).header().substr(0, 300))),
                   ErrorKind::input, "ends after 300 bytes");
}

TEST(Nifti, Damage) {
    for (const int version : {1, 2}) {
        const std::string content = NiftiFile(version).codes(1, 1).sform({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}).with(telling_bytes(48));
        expect_truncations_refused("v.nii", content);
        expect_truncations_refused("v.nii.gz", gzip(content));
        expect_bit_flips_harmless("v.nii", content, 0, static_cast<std::size_t>(version == 1 ? 352 : 544), 1);
        expect_bit_flips_harmless("v.nii.gz", gzip(content), 0, std::string::npos, 1032);
    }
}

const std::string kData = std::string(ISOATLAS_SOURCE_DIR) + "/../shared/data/";

std::string checksum(const std::string& path, std::int64_t slices) {
    oracle::Sha256 sum;
    const std::string bytes = read_all(*open_volume(path), slices);
    sum.add(std::as_bytes(std::span(bytes)));
    return sum.hex();
}

TEST(NiftiSharedData, ChecksumsAndOriginals) {
    std::ifstream file(kData + "stats.json");
    if (!file) GTEST_SKIP() << "no shared data";
    const nlohmann::json stats = nlohmann::json::parse(file);
    int files = 0;
    for (const auto& [name, facts] : stats.items()) {
        if (name.find(".nii") == std::string::npos) continue;
        EXPECT_EQ(checksum(kData + name, 7), facts.at("sha256_samples").get<std::string>()) << name;
        ++files;
    }
    EXPECT_EQ(files, 4);
    const std::pair<const char*, const char*> originals[] = {{"avg152T1/original/avg152T1_RL_nifti.nii.gz", "avg152T1/avg152T1.nrrd"},
                                                             {"engine/original/engine.nii.gz", "engine/engine.nrrd"},
                                                             {"fuel/original/fuel.nii.gz", "fuel/fuel.nrrd"},
                                                             {"stroke/original/T1.nii.gz", "stroke/T1.nrrd"}};
    for (const auto& [original, converted] : originals)
        EXPECT_EQ(checksum(kData + original, 16), stats.at(converted).at("sha256_samples").get<std::string>()) << original;
}

TEST(NiftiSharedData, FourDimensionsAndCalibration) {
    const std::string path = kData + "functional4d/original/functional.nii";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no shared data";
    expect_reason(failure_of_loading(path), ErrorKind::usage, Reason::time_step_needed, "19");
    for (const std::int64_t step : {0, 7, 19}) {
        OpenOptions options;
        options.time_step = step;
        EXPECT_EQ(read_all(*open_volume(path, options), 2), read_all(*open_volume(kData + "functional4d/functional4d.nrrd", options), 2));
        EXPECT_FALSE(open_volume(path, options)->info().calibration.is_identity());
    }
    EXPECT_NO_THROW(static_cast<void>(load_volume(kData + "functional4d/original/anatomical.nii")));
}

/// The four files are one head stored along different axes: each brings the same voxel to the same place.
TEST(NiftiSharedData, OrientationsAgreeInSpace) {
    if (!std::filesystem::exists(kData + "nifti_orientations")) GTEST_SKIP() << "no shared data";
    const auto centre_of_mass = [&](const char* name) {
        const Volume volume = load_volume(kData + "nifti_orientations/" + name + ".nii.gz");
        Vec3 sum{};
        double mass = 0;
        for (std::int64_t i = 0; i < volume.info.extent.voxels(); ++i) {
            const auto voxel = volume.info.extent.voxel(i);
            const Vec3 place = to_physical(volume.info.geometry, {double(voxel[0]), double(voxel[1]), double(voxel[2])});
            for (int axis = 0; axis < 3; ++axis) sum[axis] += volume.value(i) * place[axis];
            mass += volume.value(i);
        }
        return Vec3{sum[0] / mass, sum[1] / mass, sum[2] / mass};
    };
    const Vec3 reference = centre_of_mass("RAS");
    for (const char* name : {"LPI", "AIL", "SRP"}) {
        const Vec3 other = centre_of_mass(name);
        for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(other[axis], reference[axis], 0.01) << name << " axis " << axis;
    }
}

}  // namespace
}  // namespace isoatlas
