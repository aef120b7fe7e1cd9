// TIFF: types, byte orders, strips and tiles, compressions, descriptions, damage, and the files of the shared data.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "formats/volume/tiff_description.h"
#include "oracle/sha256.h"
#include "unit/formats/volume/hostile_files.h"
#include "unit/formats/volume/tiff_files.h"
#include "unit/formats/volume/volume_files.h"

namespace isoatlas {
namespace {

using namespace test;

constexpr ValueType kTypes[] = {ValueType::u8,  ValueType::i8,  ValueType::u16, ValueType::i16,
                                ValueType::u32, ValueType::i32, ValueType::f32, ValueType::f64};

std::string samples_of(const TiffRecipe& r) {
    return telling_bytes(static_cast<std::size_t>(r.width * r.height * r.pages * r.samples_per_pixel) * size_of(r.type));
}
std::string make(const TestFolder& folder, const TiffRecipe& r, const std::string& name = "v.tif") {
    write_tiff_file(folder / name, r, samples_of(r));
    return folder / name;
}
std::string content_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

TEST(Tiff, EveryTypeByteOrderLayoutAndCompression) {
    const TestFolder folder;
    for (const ValueType type : kTypes) {
        for (const char* mode : {"wl", "wb", "wl8", "wb8"}) {
            for (const int tile : {0, 16}) {
                for (const int compression : {COMPRESSION_NONE, COMPRESSION_LZW, COMPRESSION_ADOBE_DEFLATE, COMPRESSION_PACKBITS,
                                              COMPRESSION_LZMA, COMPRESSION_ZSTD}) {
                    if (TIFFIsCODECConfigured(static_cast<std::uint16_t>(compression)) == 0) continue;
                    const TiffRecipe r{.width = 19,
                                       .height = 18,
                                       .pages = 2,
                                       .type = type,
                                       .compression = compression,
                                       .mode = mode,
                                       .rows_per_strip = 5,
                                       .tile = tile,
                                       .description = {}};
                    const std::string path = make(folder, r);
                    const auto reader = open_volume(path);
                    SCOPED_TRACE(std::string(name_of(type)) + " " + mode + " tile " + std::to_string(tile) + " compression " +
                                 std::to_string(compression));
                    ASSERT_EQ(reader->info().type, type);
                    ASSERT_EQ(reader->info().extent, (Extent{.rank = 3, .size = {19, 18, 2}}));
                    ASSERT_EQ(reader->info().format, mode[2] == '8' ? "BigTIFF" : "TIFF");
                    ASSERT_EQ(reader->info().big_endian, mode[1] == 'b');
                    ASSERT_TRUE(read_all(*reader, 2) == samples_of(r));
                }
            }
        }
    }
}

TEST(Tiff, SlabsOfAnySize) {
    const TestFolder folder;
    expect_slabs_equal_whole(make(folder, {.pages = 7, .description = {}}));
    expect_slabs_equal_whole(make(folder, {.pages = 7, .compression = COMPRESSION_LZW, .tile = 16, .description = {}}));
}

TEST(Tiff, OnePageIsAnImage) {
    const TestFolder folder;
    EXPECT_EQ(open_volume(make(folder, {.pages = 1, .description = {}}))->info().extent, (Extent{.rank = 2, .size = {5, 4, 1}}));
}

TEST(Tiff, VoxelSize) {
    const TestFolder folder;
    const auto geometry = [&](TiffRecipe r) { return open_volume(make(folder, r))->info().geometry; };
    EXPECT_EQ(geometry({.description = {}}), Geometry{});
    const Geometry imagej = geometry({.description = "ImageJ=1.53f\nimages=3\nslices=3\nunit=\\u00B5m\nspacing=2.5\n",
                                      .x_resolution = 4,
                                      .y_resolution = 2,
                                      .resolution_unit = RESUNIT_NONE});
    EXPECT_EQ(imagej, (Geometry{.spacing = {0.25, 0.5, 2.5}, .unit = "\u00b5m"}));
    EXPECT_EQ(geometry({.description = {}, .x_resolution = 100, .y_resolution = 50, .resolution_unit = RESUNIT_CENTIMETER}),
              (Geometry{.spacing = {0.1, 0.2, 0.1}, .unit = "mm"}));
    EXPECT_EQ(geometry({.description = {}, .x_resolution = 254, .y_resolution = 254, .resolution_unit = RESUNIT_INCH}).spacing[0],
              25.4 / 254);
    EXPECT_EQ(geometry({.description = {}, .x_resolution = 3, .y_resolution = 1, .resolution_unit = RESUNIT_NONE}).spacing,
              (Vec3{1, 3, 1}));
    const Geometry ome =
        geometry({.description =
                      "<?xml version=\"1.0\"?><OME xmlns=\"o\"><Image><Pixels SizeC=\"1\" SizeT=\"1\" SizeZ=\"3\" DimensionOrder=\"XYZCT\" "
                      "PhysicalSizeX=\"0.5\" PhysicalSizeY=\"0.25\" PhysicalSizeZ=\"2\"/></Image></OME>"});
    EXPECT_EQ(ome, (Geometry{.spacing = {0.5, 0.25, 2}, .unit = "\u00b5m"}));
}

TEST(Tiff, CalibrationOfImageJ) {
    const TestFolder folder;
    const auto info = open_volume(make(folder, {.description = "ImageJ=1.53f\nslices=3\ncf=0\nc0=-32768.0\nc1=2\nvunit=HU\n"}))->info();
    EXPECT_EQ(info.calibration, (Calibration{2, -32768}));
    EXPECT_EQ(info.value_unit, "HU");
}

TEST(Tiff, SeriesAndChannels) {
    const TestFolder folder;
    const std::string series = make(folder, {.pages = 6, .description = "ImageJ=1.53f\nimages=6\nslices=2\nframes=3\n"});
    const std::string samples = samples_of({.pages = 6, .description = {}});
    expect_reason(failure_of_loading(series), ErrorKind::usage, Reason::time_step_needed, "2");
    OpenOptions options;
    options.time_step = 1;
    EXPECT_EQ(read_all(*open_volume(series, options), 2), samples.substr(80, 80));
    const std::string ome = make(
        folder,
        {.pages = 6, .description = "<OME><Image><Pixels SizeC=\"1\" SizeT=\"3\" SizeZ=\"2\" DimensionOrder=\"XYTZC\"/></Image></OME>"});
    EXPECT_EQ(read_all(*open_volume(ome, options), 2), samples.substr(40, 40) + samples.substr(160, 40));
    const std::string frames = make(folder, {.pages = 6, .description = "ImageJ=1.53f\nimages=6\nframes=6\n"});
    EXPECT_EQ(open_volume(frames)->info().extent.size[2], 6);
    EXPECT_EQ(open_volume(frames)->info().notes.size(), 1U);
    EXPECT_EQ(open_volume(frames, options)->info().extent, (Extent{.rank = 2, .size = {5, 4, 1}}));
    EXPECT_EQ(read_all(*open_volume(frames, options), 1), samples.substr(40, 40));
    const std::string channels = make(folder, {.pages = 6, .description = "ImageJ=1.53f\nimages=6\nchannels=2\nslices=3\n"});
    expect_reason(failure_of_loading(channels), ErrorKind::usage, Reason::channel_needed);
    options = {};
    options.channel = "1";
    EXPECT_EQ(read_all(*open_volume(channels, options), 2), samples.substr(40, 40) + samples.substr(120, 40) + samples.substr(200, 40));
}

/// ImageJ writes large stacks as one directory; the other pages follow its pixels.
TEST(Tiff, ManyPagesBehindOneDirectory) {
    const TestFolder folder;
    for (const char* mode : {"wl", "wb"}) {
        const TiffRecipe first{.pages = 1, .mode = mode, .rows_per_strip = 4, .description = "ImageJ=1.53f\nimages=3\nslices=3\n"};
        write_tiff_file(folder / "v.tif", first, telling_bytes(40));
        std::string content = content_of(folder / "v.tif");
        // libtiff puts the pixels first (byte 8) and the directory behind: move the pixels to the end and let the strip point there.
        const std::uint32_t at = static_cast<std::uint32_t>(content.size());
        const bool big = mode[1] == 'b';
        const std::string tag = big ? std::string("\x01\x11\x00\x04", 4) : std::string("\x11\x01\x04\x00", 4);
        std::string offset(reinterpret_cast<const char*>(&at), 4);
        if (big) std::reverse(offset.begin(), offset.end());
        const std::size_t entry = content.find(tag);
        ASSERT_NE(entry, std::string::npos);
        content.replace(entry + 8, 4, offset);
        const std::string samples = telling_bytes(120);
        const std::string path = folder.write("large.tif", content + (big ? swapped(samples, 2) : samples));
        EXPECT_EQ(open_volume(path)->info().extent, (Extent{.rank = 3, .size = {5, 4, 3}}));
        EXPECT_EQ(read_all(*open_volume(path), 3), samples);
        expect_slabs_equal_whole(path);
    }
}

TEST(Tiff, WhatIsNotRead) {
    const TestFolder folder;
    expect_helpful(failure_of_loading(make(
                       folder, {.type = ValueType::u8, .samples_per_pixel = 4, .photometric = PHOTOMETRIC_SEPARATED, .description = {}})),
                   ErrorKind::unsupported, "4 values per pixel");
    expect_helpful(failure_of_loading(make(folder, {.width = 8, .type = ValueType::u8, .description = {}, .bits = 1})),
                   ErrorKind::unsupported, "1-bit");
    expect_helpful(failure_of_loading(make(folder, {.type = ValueType::u16, .description = {}, .bits = 12})), ErrorKind::unsupported,
                   "12-bit");
    expect_helpful(failure_of_loading(folder.write("no.tif", "this is no TIFF file")), ErrorKind::input, "named like TIFF");
    std::string broken = content_of(make(folder, {.description = {}}));
    broken.resize(9);
    expect_helpful(failure_of_loading(folder.write("short.tif", broken)), ErrorKind::input, "TIFF");
}

TEST(Tiff, PagesOfDifferentSize) {
    const TestFolder folder;
    for (const TiffRecipe& other : {TiffRecipe{.width = 6, .pages = 1, .mode = "al", .description = {}},
                                    TiffRecipe{.pages = 1, .type = ValueType::i16, .mode = "al", .description = {}}}) {
        const std::string path = make(folder, {.pages = 2, .description = {}});
        write_tiff_file(path, other, samples_of(other));
        expect_helpful(failure_of_loading(path), ErrorKind::input, "page 2");
    }
}

TEST(Tiff, PreviewsAreLeftOut) {
    const TestFolder folder;
    const TiffRecipe r{.pages = 2, .description = {}};
    const std::string path = make(folder, r);
    TIFF* tiff = TIFFOpen(path.c_str(), "al");
    const std::string small(4, 'x');
    for (const auto& [tag, value] : {std::pair{TIFFTAG_SUBFILETYPE, FILETYPE_REDUCEDIMAGE},
                                     {TIFFTAG_IMAGEWIDTH, 2},
                                     {TIFFTAG_IMAGELENGTH, 2},
                                     {TIFFTAG_BITSPERSAMPLE, 8},
                                     {TIFFTAG_SAMPLESPERPIXEL, 1},
                                     {TIFFTAG_ROWSPERSTRIP, 2}}) {
        TIFFSetField(tiff, static_cast<std::uint32_t>(tag), value);
    }
    TIFFWriteEncodedStrip(tiff, 0, const_cast<char*>(small.data()), 4);
    TIFFClose(tiff);
    EXPECT_EQ(read_all(*open_volume(path), 2), samples_of(r));
    EXPECT_EQ(open_volume(path)->info().notes.size(), 1U);
}

TEST(Tiff, Damage) {
    const TestFolder folder;
    const std::string plain = content_of(make(folder, {.width = 3, .height = 2, .pages = 2, .description = {}}));
    expect_truncations_refused("v.tif", plain);
    expect_bit_flips_harmless("v.tif", plain, 0, std::string::npos, 1);
    const std::string packed =
        content_of(make(folder, {.width = 3, .height = 2, .pages = 2, .compression = COMPRESSION_LZW, .tile = 16, .description = {}}));
    expect_truncations_refused("v.tif", packed);
    expect_bit_flips_harmless("v.tif", packed, 0, std::string::npos, 1 << 20);
}

TEST(Tiff, DescriptionsOfAllKinds) {
    EXPECT_FALSE(parse_tiff_description("").is_imagej);
    EXPECT_FALSE(parse_tiff_description("{\"shape\": [31, 61, 57]}").is_imagej);
    const TiffDescription nonsense =
        parse_tiff_description("ImageJ=\nimages=-7\nframes=99999999999999999999\nspacing=nan\ncf=0\nc1=0\nunit=furlong");
    EXPECT_EQ(nonsense.images, 0);
    EXPECT_EQ(nonsense.frames, 1);
    EXPECT_EQ(nonsense.spacing[2], 0);
    EXPECT_EQ(nonsense.unit, "");
    EXPECT_TRUE(nonsense.calibration.is_identity());
    EXPECT_EQ(parse_tiff_description("ImageJ=1\nunit=micron").unit, "um");
    EXPECT_EQ(parse_tiff_description("ImageJ=1\nunit=\xc2\xb5m").unit, "um");
}

const std::string kData = std::string(ISOATLAS_SOURCE_DIR) + "/../shared/data/";

TEST(TiffSharedData, OriginalsEqualTheConvertedFiles) {
    std::ifstream file(kData + "stats.json");
    if (!file) GTEST_SKIP() << "no shared data";
    const nlohmann::json stats = nlohmann::json::parse(file);
    const std::pair<const char*, const char*> originals[] = {{"beads/original/Bead_Image1_crop.tif", "beads/beads.nrrd"},
                                                             {"flybrain/original/flybrain.tif", "flybrain/flybrain.nrrd"},
                                                             {"nuclei/original/img3d.tif", "nuclei/nuclei.nrrd"}};
    for (const auto& [original, converted] : originals) {
        for (const std::int64_t slices : {1, 11, 1000}) {
            oracle::Sha256 sum;
            const std::string bytes = read_all(*open_volume(kData + original), slices);
            sum.add(std::as_bytes(std::span(bytes)));
            EXPECT_EQ(sum.hex(), stats.at(converted).at("sha256_samples").get<std::string>()) << original;
        }
    }
    const Geometry beads = open_volume(kData + "beads/original/Bead_Image1_crop.tif")->info().geometry;
    EXPECT_NEAR(beads.spacing[0], 1 / 44.460534, 1e-9);
    EXPECT_EQ(beads.spacing[2], 0.125);
    EXPECT_EQ(beads.unit, "\u00b5m");
}

}  // namespace
}  // namespace isoatlas
