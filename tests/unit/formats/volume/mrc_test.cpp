// MRC and CCP4 maps: types, byte orders, axes, places, stacks, refusals; what is written comes back.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include "formats/volume/half_source.h"
#include "isoatlas/output.h"
#include "isoatlas/phantom.h"
#include "unit/formats/volume/bzip2_stream.h"
#include "unit/formats/volume/hostile_files.h"

namespace isoatlas {
namespace {

using test::expect_helpful;
using test::failure_of_loading;

/// A header of 256 words in this or the other byte order, then an extended header and samples.
class MrcFile {
public:
    MrcFile(std::array<std::int32_t, 3> size, std::int32_t mode) {
        for (std::size_t i = 0; i < 3; ++i)
            put(i, size[i]), put(7 + i, size[i]), put(10 + i, static_cast<float>(size[i]) * 2), put(13 + i, 90.0F);
        put(3, mode), put(16, 1), put(17, 2), put(18, 3), put(22, 1);
        mark(208, "MAP ");
    }
    template <class T>
    MrcFile& put(std::size_t word, T value) {
        static_assert(sizeof(T) == 4);
        words_[word] = std::bit_cast<std::uint32_t>(value);
        return *this;
    }
    MrcFile& mark(std::size_t byte, const std::string& text) {
        marks_.emplace_back(byte, text);
        return *this;
    }
    [[nodiscard]] std::string bytes(const std::string& samples, bool big = false, const std::string& extended = "") const {
        std::string file(reinterpret_cast<const char*>(words_.data()), sizeof words_);
        if (big) file = test::swapped(file, 4);
        file.replace(212, 2, big ? "\x11\x11" : "\x44\x44");
        for (const auto& [byte, text] : marks_) file.replace(byte, text.size(), text);
        return file + extended + samples;
    }

private:
    std::array<std::uint32_t, 256> words_{};
    std::vector<std::pair<std::size_t, std::string>> marks_;
};

TEST(Mrc, EveryTypeAndByteOrder) {
    const test::TestFolder folder;
    const std::pair<int, ValueType> modes[] = {{0, ValueType::i8}, {1, ValueType::i16}, {2, ValueType::f32}, {6, ValueType::u16}};
    for (const auto& [mode, type] : modes) {
        const std::string samples = test::telling_bytes(24 * size_of(type));
        for (const bool big : {false, true}) {
            SCOPED_TRACE(std::to_string(mode) + (big ? " big" : " little"));
            const std::string path =
                folder.write("v.bin", MrcFile({2, 3, 4}, mode).bytes(big ? test::swapped(samples, size_of(type)) : samples, big));
            const auto reader = open_volume(path);
            EXPECT_EQ(reader->info().format, "MRC");
            EXPECT_EQ(reader->info().type, type);
            EXPECT_EQ(reader->info().extent, (Extent{3, {2, 3, 4}}));
            EXPECT_EQ(reader->info().geometry.spacing, (Vec3{2, 2, 2}));
            EXPECT_EQ(reader->info().geometry.unit, "\xc3\x85");
            EXPECT_TRUE(reader->info().slab_readable);
            for (std::int64_t slices = 1; slices <= 4; ++slices) EXPECT_EQ(test::read_all(*reader, slices), samples);
        }
    }
}

TEST(Mrc, BytesOfImodAreUnsigned) {
    const test::TestFolder folder;
    const auto type = [&](std::int32_t stamp, std::int32_t flags) {
        return open_volume(folder.write("v.mrc", MrcFile({2, 2, 2}, 0).put(38, stamp).put(39, flags).bytes("abcdefgh")))->info().type;
    };
    EXPECT_EQ(type(1146047817, 0), ValueType::u8);
    EXPECT_EQ(type(1146047817, 1), ValueType::i8);
    EXPECT_EQ(type(0, 0), ValueType::i8);
}

TEST(Mrc, EveryHalfIsTheSameFloat) {
    for (std::uint32_t bits = 0; bits < 0x10000; ++bits) {
        const std::uint32_t exponent = bits >> 10 & 31, fraction = bits & 1023;
        const double sign = (bits & 0x8000) != 0 ? -1 : 1;
        const float got = float_of_half(static_cast<std::uint16_t>(bits));
        if (exponent == 31 && fraction != 0) {
            EXPECT_TRUE(std::isnan(got)) << bits;
            continue;
        }
        const double expected = exponent == 31  ? sign * std::numeric_limits<double>::infinity()
                                : exponent == 0 ? sign * std::ldexp(fraction, -24)
                                                : sign * std::ldexp(1024 + fraction, static_cast<int>(exponent) - 25);
        EXPECT_EQ(static_cast<double>(got), expected) << bits;
        EXPECT_EQ(std::signbit(got), sign < 0) << bits;
    }
}

TEST(Mrc, HalvesAreReadInAnySlabs) {
    const test::TestFolder folder;
    std::string halves(2 * 24, '\0');
    std::vector<float> expected;
    for (std::size_t i = 0; i < 24; ++i) {
        const auto bits = static_cast<std::uint16_t>(0x3c00 + 37 * i);
        std::memcpy(halves.data() + 2 * i, &bits, 2);
        expected.push_back(float_of_half(bits));
    }
    const std::string floats(reinterpret_cast<const char*>(expected.data()), 4 * expected.size());
    for (const bool big : {false, true}) {
        const std::string path = folder.write("v.mrc", MrcFile({2, 3, 4}, 12).bytes(big ? test::swapped(halves, 2) : halves, big));
        const auto reader = open_volume(path);
        EXPECT_EQ(reader->info().type, ValueType::f32);
        for (std::int64_t slices = 1; slices <= 4; ++slices) EXPECT_EQ(test::read_all(*reader, slices), floats);
    }
    expect_helpful(failure_of_loading(folder.write("v.mrc", MrcFile({2, 3, 4}, 12).bytes(halves.substr(2)))), ErrorKind::input,
                   "truncated");
    expect_helpful(failure_of_loading(folder.write("v.mrc", MrcFile({2, 3, 4}, 12).bytes(halves + "more"))), ErrorKind::input, "after");
}

TEST(Mrc, AxesStartAndOrigin) {
    const test::TestFolder folder;
    const auto geometry = [&](const MrcFile& file) {
        return open_volume(folder.write("v.mrc", file.bytes(std::string(24, 'x'))))->info().geometry;
    };
    MrcFile file({2, 3, 4}, 0);
    for (std::size_t k = 0; k < 3; ++k) file.put(7 + k, std::int32_t{10}).put(10 + k, 10 * static_cast<float>(k + 1));  // spacings 1, 2, 3
    file.put(4, std::int32_t{1}).put(5, std::int32_t{-2}).put(6, std::int32_t{5});
    EXPECT_EQ(geometry(file).spacing, (Vec3{1, 2, 3}));
    EXPECT_EQ(geometry(file).origin, (Vec3{1, -4, 15}));
    file.put(16, std::int32_t{3}).put(17, std::int32_t{1}).put(18, std::int32_t{2});  // columns along Z, rows along X, sections along Y
    const Geometry turned = geometry(file);
    EXPECT_EQ(turned.spacing, (Vec3{3, 1, 2}));
    EXPECT_EQ(turned.direction, (Mat3{{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}}}));
    EXPECT_EQ(turned.origin, (Vec3{-2, 10, 3}));
    EXPECT_EQ(to_physical(turned, {1, 0, 0}), (Vec3{-2, 10, 6}));
    file.put(49, 7.0F).put(50, 8.0F).put(51, 9.0F);
    EXPECT_EQ(geometry(file).origin, (Vec3{7, 8, 9}));
    file.put(14, 60.0F);  // between X and Z
    const Geometry sheared = geometry(file);
    const Vec3 along_z = to_physical(sheared, {1, 0, 0});
    EXPECT_NEAR(along_z[0] - 7, 3 * std::cos(std::numbers::pi / 3), 1e-12);
    EXPECT_NEAR(along_z[2] - 9, 3 * std::sin(std::numbers::pi / 3), 1e-12);
    EXPECT_NEAR(skew_of(sheared, 3), std::sin(std::numbers::pi / 3), 1e-12);
}

TEST(Mrc, OldFilesNeedAName) {
    const test::TestFolder folder;
    const std::string old = MrcFile({2, 2, 2}, 0).mark(208, std::string(8, '\0')).put(16, 0).put(17, 0).put(18, 0).bytes("abcdefgh");
    EXPECT_EQ(open_volume(folder.write("v.mrc", old))->info().extent, (Extent{3, {2, 2, 2}}));
    EXPECT_EQ(failure_of_loading(folder.write("v.bin", old)).kind, ErrorKind::unsupported);
}

TEST(Mrc, ImagesStacksAndExtendedHeaders) {
    const test::TestFolder folder;
    EXPECT_EQ(open_volume(folder.write("v.mrc", MrcFile({4, 2, 1}, 0).put(22, 0).bytes("abcdefgh")))->info().extent,
              (Extent{2, {4, 2, 1}}));
    const std::string extended = MrcFile({2, 2, 2}, 0).put(23, std::int32_t{5}).bytes("abcdefgh", false, "12345");
    EXPECT_EQ(test::text_of_bytes(load_volume(folder.write("v.mrc", extended))), "abcdefgh");
    const std::string stack = MrcFile({2, 2, 4}, 0).put(22, std::int32_t{401}).put(9, std::int32_t{2}).bytes("abcdefghijklmnop");
    expect_reason(failure_of_loading(folder.write("v.mrc", stack)), ErrorKind::usage, Reason::time_step_needed, "1");
    OpenOptions options;
    options.time_step = 1;
    EXPECT_EQ(test::text_of_bytes(load_volume(folder.write("v.mrc", stack), options)), "ijklmnop");
}

TEST(Mrc, Refusals) {
    const test::TestFolder folder;
    const std::string eight(8, 'x');
    const auto refused = [&](const std::string& bytes, ErrorKind kind, const std::string& says) {
        expect_helpful(failure_of_loading(folder.write("v.mrc", bytes)), kind, says);
    };
    for (const auto& [mode, what] : {std::pair{3, "complex"}, {4, "complex"}, {16, "RGB"}, {101, "4-bit"}, {5, "mode 5"}})
        refused(MrcFile({2, 2, 2}, mode).bytes(eight), ErrorKind::unsupported, what);
    refused(MrcFile({2, 2, 2}, 0).put(16, 2).bytes(eight), ErrorKind::input, "same axis");
    refused(MrcFile({2, 2, 2}, 0).put(14, 180.0F).bytes(eight), ErrorKind::input, "angle");
    refused(MrcFile({2, 2, 2}, 0).put(13, 170.0F).put(14, 170.0F).put(15, 170.0F).bytes(eight), ErrorKind::input, "volume");
    refused(MrcFile({2, 2, 3}, 0).put(22, 401).put(9, 2).bytes(eight + "abcd"), ErrorKind::input, "stack");
    refused(MrcFile({2, 2, 2}, 0).bytes(eight.substr(1)), ErrorKind::input, "7");
    refused(MrcFile({2, 2, 2}, 0).bytes(eight + "y"), ErrorKind::input, "after");
    refused(MrcFile({0x7fffffff, 0x7fffffff, 0x7fffffff}, 2).bytes(eight), ErrorKind::input, "63 bits");
    refused(MrcFile({0x7fffffff, 0x7fffffff, 1}, 0).bytes(eight), ErrorKind::input, "8");
    refused(MrcFile({2, 2, 2}, 0).put(23, std::int32_t{0x7fffffff}).bytes(eight), ErrorKind::input, "");
}

TEST(Mrc, Damage) {
    const std::string content = MrcFile({2, 3, 4}, 1).bytes(test::telling_bytes(48));
    test::expect_truncations_refused("v.mrc", content);
    test::expect_bit_flips_harmless("v.mrc", content, 0, 240, 2);
    test::expect_bit_flips_harmless("v.mrc", MrcFile({2, 3, 4}, 12).bytes(test::telling_bytes(48)), 0, 240, 2);
}

TEST(Mrc, WholeFilesMayBePacked) {
    const test::TestFolder folder;
    const std::string samples = test::telling_bytes(48), content = MrcFile({2, 3, 4}, 1).bytes(samples, false, std::string(96, 'x'));
    const std::string extended = MrcFile({2, 3, 4}, 1).put(23, std::int32_t{96}).bytes(samples, false, std::string(96, 'x'));
    const std::pair<const char*, std::string> files[] = {
        {"v.map.gz", test::gzip(extended)}, {"v.bin", test::gzip(extended)}, {"v.mrc.bz2", test::bzip2(extended)}};
    for (const auto& [name, bytes] : files) {
        SCOPED_TRACE(name);
        const auto reader = open_volume(folder.write(name, bytes));
        EXPECT_EQ(reader->info().format, "MRC");
        EXPECT_EQ(reader->info().encoding, std::string_view(name).ends_with("bz2") ? "bzip2" : "gzip");
        EXPECT_FALSE(reader->info().slab_readable);
        EXPECT_EQ(reader->info().file_bytes, static_cast<std::int64_t>(bytes.size()));
        for (std::int64_t slices = 4; slices >= 1; --slices) EXPECT_EQ(test::read_all(*reader, slices), samples);
    }
    const std::string old = MrcFile({2, 3, 4}, 1).mark(208, std::string(4, '\0')).bytes(samples);  // known by its name alone
    EXPECT_EQ(open_volume(folder.write("old.ccp4.gz", test::gzip(old)))->info().format, "MRC");
    expect_helpful(failure_of_loading(folder.write("v.map.bz2", test::bzip2(content))), ErrorKind::input, "after the samples");
    expect_helpful(failure_of_loading(folder.write("v.map.gz", test::gzip(extended.substr(0, extended.size() - 1)))), ErrorKind::input,
                   "end early");
    expect_helpful(failure_of_loading(folder.write("v.map.gz", test::gzip(extended.substr(0, 500)))), ErrorKind::input, "named like MRC");
    for (const std::string& packed : {test::gzip(extended), test::bzip2(extended)}) {
        test::expect_truncations_refused("v.map.packed", packed);
        test::expect_bit_flips_harmless("v.map.packed", packed, 0, std::string::npos, std::int64_t{1} << 21);
    }
}

TEST(Mrc, WhatIsWrittenComesBack) {
    const test::TestFolder folder;
    for (const ValueType type : {ValueType::i8, ValueType::i16, ValueType::u16, ValueType::f32, ValueType::u8}) {
        Geometry geometry;
        geometry.spacing = {2, 4, 8}, geometry.origin = {1, -2, 3}, geometry.unit = "nm";
        geometry.direction = {{{0, 1, 0}, {1, 0, 0}, {0, 0, 1}}};
        Volume volume = make_volume({3, {3, 4, 5}}, type, geometry);
        const std::string told = test::telling_bytes(volume.bytes.size());
        std::memcpy(volume.bytes.data(), told.data(), told.size());
        write_volume(folder / "v.mrc", volume);
        const Volume back = load_volume(folder / "v.mrc");
        EXPECT_EQ(back.info.type, type == ValueType::u8 ? ValueType::u16 : type);
        EXPECT_EQ(back.info.geometry.spacing, (Vec3{20, 40, 80}));
        EXPECT_EQ(back.info.geometry.origin, (Vec3{10, -20, 30}));
        EXPECT_EQ(back.info.geometry.direction, geometry.direction);
        EXPECT_EQ(back.info.geometry.unit, "\xc3\x85");
        for (std::int64_t i = 0; i < volume.info.extent.voxels(); ++i) {
            const double one = volume.value(i), other = back.value(i);
            EXPECT_TRUE(one == other || (std::isnan(one) && std::isnan(other))) << i;
        }
    }
    const test::Failure wide = test::failure_of([&] { write_volume(folder / "v.mrc", make_volume({3, {2, 2, 2}}, ValueType::f64, {})); });
    expect_helpful(wide, ErrorKind::unsupported, "float64");
}

TEST(Mrc, ObliqueAxesAreWrittenWhereMrcCanSayThem) {
    const test::TestFolder folder;
    Geometry geometry;
    geometry.unit = "\xc3\x85";
    geometry.direction = {{{0.5, 1, 0.1}, {std::sqrt(0.75), 0, 0.2}, {0, 0, std::sqrt(0.95)}}};  // columns in the plane, rows along X
    Volume volume = make_volume({3, {2, 3, 4}}, ValueType::i8, geometry);
    write_volume(folder / "v.mrc", volume);
    const Geometry back = load_volume(folder / "v.mrc").info.geometry;
    for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t a = 0; a < 3; ++a) EXPECT_NEAR(back.direction[row][a], geometry.direction[row][a], 1e-6) << row << a;
    }
    volume.info.geometry.direction = {{{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    write_volume(folder / "v.mrc", volume);
    const VolumeInfo flipped = load_volume(folder / "v.mrc").info;
    EXPECT_EQ(flipped.geometry.direction, Geometry{}.direction);
    EXPECT_NE(flipped.description.find("not kept"), std::string::npos);
}

TEST(Mrc, TheMapOfTheDataBank) {
    const std::filesystem::path data = std::filesystem::path(ISOATLAS_SOURCE_DIR).parent_path() / "shared" / "data";
    if (!std::filesystem::exists(data / "formats" / "EMD-3001.map")) GTEST_SKIP() << "no shared data beside the checkout";
    const Volume map = load_volume((data / "formats" / "EMD-3001.map").string());
    EXPECT_EQ(test::text_of_bytes(map), test::text_of_bytes(load_volume((data / "formats" / "EMD-3001.map.bz2").string())));
    const Volume converted = load_volume((data / "emd3001" / "emd3001.nrrd").string());
    EXPECT_EQ(map.info.extent, converted.info.extent);
    EXPECT_EQ(test::text_of_bytes(map), test::text_of_bytes(converted));
    EXPECT_NEAR(map.info.geometry.spacing[0], 33.03 / 72, 1e-6);
    EXPECT_NEAR(skew_of(map.info.geometry, 3), std::sin(94.326 * std::numbers::pi / 180), 1e-6);
}

}  // namespace
}  // namespace isoatlas
