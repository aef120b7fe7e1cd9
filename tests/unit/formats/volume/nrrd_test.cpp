// NRRD: every variant of the same samples reads to the same bytes; geometry, axes and refusals.
#include <gtest/gtest.h>

#include "unit/formats/volume/bzip2_stream.h"
#include "unit/formats/volume/hostile_files.h"
#include "unit/formats/volume/volume_files.h"

namespace isoatlas {
namespace {

using test::expect_helpful;
using test::failure_of_loading;

struct NrrdType {
    const char* spelling;
    ValueType type;
};
constexpr NrrdType kTypes[] = {{"uchar", ValueType::u8},
                               {"uint8_t", ValueType::u8},
                               {"signed char", ValueType::i8},
                               {"unsigned short int", ValueType::u16},
                               {"uint16", ValueType::u16},
                               {"short", ValueType::i16},
                               {"signed short int", ValueType::i16},
                               {"uint", ValueType::u32},
                               {"unsigned int", ValueType::u32},
                               {"int32_t", ValueType::i32},
                               {"signed int", ValueType::i32},
                               {"float", ValueType::f32},
                               {"double", ValueType::f64}};

std::string header(const std::string& type, const std::string& more, const std::string& sizes = "5 4 3") {
    return "NRRD0004\n# comment\ntype: " + type + "\ndimension: 3\nsizes: " + sizes + "\n" + more;
}

std::string samples_of(const std::string& path, const OpenOptions& options = {}) { return test::text_of_bytes(load_volume(path, options)); }

std::string encoded(const std::string& samples, const std::string& encoding) {
    return encoding == "gzip" ? test::gzip(samples) : encoding == "bzip2" ? test::bzip2(samples) : samples;
}

TEST(Nrrd, EveryTypeEndianAndEncoding) {
    const test::TestFolder folder;
    for (const NrrdType& type : kTypes) {
        SCOPED_TRACE(type.spelling);
        const std::size_t bytes = size_of(type.type);
        const std::string samples = test::telling_bytes(60 * bytes), big = test::swapped(samples, bytes);
        const std::string gzipped = test::gzip(samples);
        const std::vector<std::pair<std::string, std::string>> files = {
            {"endian: little\nencoding: raw\n\n", samples},
            {"endian: big\nencoding: raw\n\n", big},
            {"endian: little\nencoding: gzip\n\n", gzipped},
            {"endian: big\nencoding: gz\n\n", test::gzip(big)},
            {"endian: little\nencoding: raw\nbyteskip: 7\n\n", "1234567" + samples},
            {"endian: little\nencoding: raw\nbyte skip: -1\n\n", "any number of bytes" + samples},
            {"endian: little\nencoding: raw\nline skip: 2\nbyte skip: 1\n\n", "a line\nanother\n." + samples},
            {"endian: little\nencoding: gzip\nbyte skip: 5\n\n", test::gzip("12345" + samples)},
            {"endian: little\nencoding: gzip\nline skip: 1\n\n", "a line\n" + gzipped},
            {"endian: little\nencoding: gzip\n\n", test::gzip(samples.substr(0, 11)) + test::gzip(samples.substr(11))},
            {"endian: little\nencoding: bzip2\n\n", test::bzip2(samples)},
            {"endian: big\nencoding: bz2\n\n", test::bzip2(big, 1)},
            {"endian: little\nencoding: bzip2\nbyte skip: 5\n\n", test::bzip2("12345" + samples)},
            {"endian: little\nencoding: BZ2\nline skip: 1\n\n", "a line\n" + test::bzip2(samples)},
            {"endian: little\nencoding: bzip2\n\n", test::bzip2(samples.substr(0, 11)) + test::bzip2("") + test::bzip2(samples.substr(11))},
            {"endian: little\nencoding: bzip2\n\n", test::bzip2(samples) + std::string(9, '\0')}};
        for (const auto& [more, payload] : files) {
            SCOPED_TRACE(more);
            const std::string path = folder.write("v.nrrd", header(type.spelling, more) + payload);
            const auto reader = open_volume(path);
            EXPECT_EQ(reader->info().type, type.type);
            EXPECT_EQ(reader->info().slab_readable, more.find("raw") != std::string::npos);
            EXPECT_EQ(reader->info().file_bytes, static_cast<std::int64_t>(std::filesystem::file_size(path)));
            for (std::int64_t slices = 1; slices <= 3; ++slices) EXPECT_EQ(test::read_all(*reader, slices), samples);
            EXPECT_TRUE(reader->info().notes.empty());
        }
    }
}

TEST(Nrrd, SlabsInAnyOrder) {
    const test::TestFolder folder;
    const std::string samples = test::telling_bytes(6 * 20 * 2);
    for (const std::string encoding : {"raw", "gzip", "bzip2"}) {
        const std::string path =
            folder.write("v.nrrd", header("short", "endian: little\nencoding: " + encoding + "\n\n", "5 4 6") + encoded(samples, encoding));
        const auto reader = open_volume(path);
        for (int i = 0; i < 200; ++i) {
            const std::int64_t a = i * 7 % 6, b = std::min<std::int64_t>(6, a + 1 + i % 4);
            std::string out(static_cast<std::size_t>(b - a) * 40, '\0');
            reader->read(a, b, std::as_writable_bytes(std::span(out)));
            ASSERT_EQ(out, samples.substr(static_cast<std::size_t>(a) * 40, out.size()));
        }
    }
}

TEST(Nrrd, Text) {
    const test::TestFolder folder;
    const std::string path =
        folder.write("v.nrrd", "NRRD0005\ntype: float\ndimension: 2\nsizes: 3 2\nencoding: ascii\n\n1 -2.5,+3e2\n 1e-50 nan\tinf\n");
    const auto reader = open_volume(path);
    const std::string bytes = test::read_all(*reader, 1);
    float samples[6];
    std::memcpy(samples, bytes.data(), sizeof samples);
    EXPECT_EQ(samples[0], 1);
    EXPECT_EQ(samples[1], -2.5F);
    EXPECT_EQ(samples[2], 300);
    EXPECT_EQ(samples[3], 0);
    EXPECT_TRUE(std::isnan(samples[4]));
    EXPECT_TRUE(std::isinf(samples[5]));
    EXPECT_EQ(reader->info().encoding, "ascii");
    const auto text = [&](const std::string& type, const std::string& numbers) {
        return folder.write("t.nrrd", "NRRD0001\ntype: " + type + "\ndimension: 2\nsizes: 2 2\nencoding: txt\n\n" + numbers + "\n");
    };
    EXPECT_EQ(samples_of(text("uchar", "1 2 255 0")), std::string("\x01\x02\xff\0", 4));
    expect_helpful(failure_of_loading(text("uchar", "1 2 255 0 7 8")), ErrorKind::input, "2 bytes follow");
    expect_helpful(failure_of_loading(text("uchar", "1 2 256 0")), ErrorKind::input, "'256' is not a sample");
    expect_helpful(failure_of_loading(text("uchar", "1 2 -1 0")), ErrorKind::input, "number 3");
    expect_helpful(failure_of_loading(text("uchar", "1 2   25    ")), ErrorKind::input, "ends early");
    expect_helpful(failure_of_loading(text("float", "1 2 x 4")), ErrorKind::input, "'x' is not a sample");
    expect_helpful(failure_of_loading(text("uchar", "1 2")), ErrorKind::input, "cannot hold");
}

TEST(Nrrd, DetachedListsAndSeries) {
    const test::TestFolder folder;
    const std::string samples = test::telling_bytes(120);
    std::filesystem::create_directory(folder / "data");
    folder.write("data/all.raw", samples);
    folder.write("data/all.raw.gz", test::gzip(samples));
    folder.write("data/all.raw.bz2", test::bzip2(samples));
    for (int i = 0; i < 3; ++i) {
        folder.write("data/s" + std::to_string(8 + 2 * i) + ".raw", samples.substr(static_cast<std::size_t>(i) * 40, 40));
        folder.write("data/p" +
                         std::string(i == 0   ? "008"
                                     : i == 1 ? "010"
                                              : "012") +
                         ".raw",
                     "xy" + samples.substr(static_cast<std::size_t>(i) * 40, 40));
        folder.write("data/z" + std::to_string(i) + ".gz", test::gzip(samples.substr(static_cast<std::size_t>(i) * 40, 40)));
        folder.write("data/z" + std::to_string(i) + ".bz2", test::bzip2("xyz" + samples.substr(static_cast<std::size_t>(i) * 40, 40)));
    }
    const std::string start = "endian: little\n";
    const std::vector<std::string> headers = {start + "encoding: raw\ndata file: data/all.raw\n",
                                              start + "encoding: gzip\ndatafile: ./data/all.raw.gz\n\n",
                                              start + "encoding: raw\ndata file: data/s%d.raw 8 12 2\n",
                                              start + "encoding: raw\nbyte skip: 2\ndata file: data/p%03d.raw 8 12 2 2\n",
                                              start + "encoding: raw\nbyte skip: -1\ndata file: data/p%03d.raw 8 12 2\n",
                                              start + "encoding: gzip\ndata file: LIST\ndata/z0.gz\ndata/z1.gz\ndata/z2.gz\n",
                                              start + "encoding: bzip2\ndata file: data/all.raw.bz2\n",
                                              start + "encoding: bz2\nbyte skip: 3\ndata file: data/z%d.bz2 0 2 1\n",
                                              start + "encoding: raw\ndata file: LIST 2\ndata/s8.raw\r\ndata/s10.raw\r\ndata/s12.raw\r\n"};
    for (const std::string& more : headers) {
        SCOPED_TRACE(more);
        const std::string path = folder.write("v.nhdr", header("short", more));
        EXPECT_EQ(samples_of(path), samples);
        const auto reader = open_volume(path);
        EXPECT_EQ(test::read_all(*reader, 2), samples);
        EXPECT_NE(reader->info().data_file.find("data/"), std::string::npos);
    }
    const auto failing = [&](const std::string& more) { return failure_of_loading(folder.write("v.nhdr", header("short", start + more))); };
    expect_helpful(failing("encoding: raw\ndata file: data/missing.raw\n"), ErrorKind::input, "missing.raw");
    expect_helpful(failing("encoding: raw\ndata file: data\n"), ErrorKind::input, "is a directory");
    expect_helpful(failing("encoding: raw\ndata file: data/s%d.raw 8 14 1\n"), ErrorKind::input, "evenly");
    expect_helpful(failing("encoding: raw\ndata file: data/s%d.raw 8 13 5\n"), ErrorKind::input, "at most");
    expect_helpful(failing("encoding: raw\ndata file: data/s%d.raw 8 4 2\n"), ErrorKind::input, "series");
    expect_helpful(failing("encoding: raw\ndata file: data/s%d.raw 8 12 0\n"), ErrorKind::input, "series");
    expect_helpful(failing("encoding: raw\ndata file: LIST\n"), ErrorKind::input, "empty");
    expect_helpful(failing("encoding: raw\n"), ErrorKind::input, "data file");
    expect_helpful(failing("encoding: raw\nline skip: 99\ndata file: data/s8.raw\n"), ErrorKind::input, "fewer lines");
}

TEST(Nrrd, TwoDimensionsAndThinVolumes) {
    const test::TestFolder folder;
    const auto extent = [&](const std::string& dimension, const std::string& more) {
        return open_volume(folder.write("v.nrrd", "NRRD0004\ntype: uchar\ndimension: " + dimension + "\nencoding: raw\n" + more + "\n\n" +
                                                      std::string(24, 'x')))
            ->info()
            .extent;
    };
    EXPECT_EQ(extent("2", "sizes: 6 4"), (Extent{2, {6, 4, 1}}));
    EXPECT_EQ(extent("3", "sizes: 6 4 1"), (Extent{3, {6, 4, 1}}));
    EXPECT_EQ(extent("3", "sizes: 1 24 1"), (Extent{3, {1, 24, 1}}));
    EXPECT_EQ(extent("3", "sizes: 1 6 4\nkinds: scalar domain domain"), (Extent{2, {6, 4, 1}}));
    EXPECT_EQ(extent("4", "sizes: 1 2 3 4\nkinds: stub space space space"), (Extent{3, {2, 3, 4}}));
    EXPECT_EQ(extent("3", "sizes: 6 2 2\nkinds: space space time"), (Extent{3, {6, 2, 2}}));
    EXPECT_EQ(extent("5", "sizes: 2 3 4 1 1"), (Extent{3, {2, 3, 4}}));
}

TEST(Nrrd, FourDimensionsNeedATimeStep) {
    const test::TestFolder folder;
    const std::string samples = test::telling_bytes(2 * 3 * 4 * 5 * 2);
    for (const std::string encoding : {"raw", "gzip", "bzip2"}) {
        const std::string path = folder.write(
            "v.nrrd", "NRRD0004\ntype: short\ndimension: 4\nsizes: 2 3 4 5\nkinds: space space space time\nendian: little\nencoding: " +
                          encoding + "\n\n" + encoded(samples, encoding));
        expect_reason(failure_of_loading(path), ErrorKind::usage, Reason::time_step_needed, "4");
        for (std::int64_t step = 0; step < 5; ++step) {
            OpenOptions options;
            options.time_step = step;
            EXPECT_EQ(samples_of(path, options), samples.substr(static_cast<std::size_t>(step) * 48, 48));
        }
        for (const std::int64_t step : {-1, 5}) {
            OpenOptions options;
            options.time_step = step;
            expect_helpful(failure_of_loading(path, options), ErrorKind::usage, "no time step");
        }
    }
}

Geometry geometry_of(const std::string& dimension, const std::string& sizes, const std::string& more) {
    const test::TestFolder folder;
    OpenOptions options;
    options.skip_rest = true;
    return open_volume(folder.write("v.nrrd", "NRRD0005\ntype: uchar\ndimension: " + dimension + "\nsizes: " + sizes + "\nencoding: raw\n" +
                                                  more + "\n\n" + std::string(400, 'x')),
                       options)
        ->info()
        .geometry;
}

TEST(Nrrd, Geometry) {
    const Geometry oriented = geometry_of("3", "2 3 4",
                                          "space: right-anterior-superior\nspace directions: (0,0,2) (-3,0,0) (0, 4 ,0)\n"
                                          "space origin: (1,2.5,-3)\nspace units: \"mm\" \"mm\" \"mm\"");
    EXPECT_EQ(oriented.spacing, (Vec3{2, 3, 4}));
    EXPECT_EQ(oriented.direction, (Mat3{{{0, -1, 0}, {0, 0, 1}, {1, 0, 0}}}));
    EXPECT_EQ(oriented.origin, (Vec3{1, 2.5, -3}));
    EXPECT_EQ(oriented.space, "RAS");
    EXPECT_EQ(oriented.unit, "mm");
    EXPECT_EQ(to_physical(oriented, {1, 1, 1}), (Vec3{1 - 3, 2.5 + 4, -3 + 2}));

    const Geometry plain = geometry_of("3", "2 3 4", "spacings: 0.5 -2 nan\naxis mins: 10 20 nan\nunits: \"um\" \"um\" \"um\"");
    EXPECT_EQ(plain.spacing, (Vec3{0.5, 2, 1}));
    EXPECT_EQ(plain.direction[1][1], -1);
    EXPECT_EQ(plain.origin, (Vec3{10, 20, 0}));
    EXPECT_EQ(plain.unit, "\u00b5m");
    EXPECT_EQ(plain.space, "unknown");

    const Geometry ends = geometry_of("2", "5 4", "axis mins: 0 0\naxis maxs: 8 8\ncenters: node cell");
    EXPECT_EQ(ends.spacing, (Vec3{2, 2, 1}));
    EXPECT_EQ(ends.origin, (Vec3{0, 1, 0}));

    const Geometry slice = geometry_of("2", "5 4", "space: LPS\nspace directions: (0,2,0) (0,0,3)\nspace origin: (1,2,3)");
    EXPECT_EQ(slice.direction, (Mat3{{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}}));
    EXPECT_EQ(slice.origin, (Vec3{1, 2, 3}));

    const Geometry series =
        geometry_of("4", "2 3 4 1", "space: LPS\nspace directions: (1,0,0) (0,1,0) (0,0,2) none\nkinds: domain domain domain list");
    EXPECT_EQ(series.spacing, (Vec3{1, 1, 2}));
    EXPECT_EQ(geometry_of("3", "2 3 4", "space directions: (1,0,0) (1,0,0) (0,0,2)").direction, Geometry{}.direction);
}

TEST(Nrrd, CalibrationUnitsAndDescription) {
    const test::TestFolder folder;
    const auto info = open_volume(folder.write("v.nrrd", header("uchar",
                                                                "encoding: raw\ncontent: a thing\nsample units: HU\ncalibration_slope:=-2\n"
                                                                "calibration_intercept:=0.5\nother key:=value\n\n") +
                                                             std::string(60, 'x')))
                          ->info();
    EXPECT_EQ(info.calibration, (Calibration{-2, 0.5}));
    EXPECT_EQ(info.value_unit, "HU");
    EXPECT_EQ(info.description, "a thing");
    EXPECT_EQ(info.format, "NRRD");
    const auto zero =
        open_volume(folder.write("v.nrrd", header("uchar", "encoding: raw\ncalibration_slope:=0\n\n") + std::string(60, 'x')))->info();
    EXPECT_TRUE(zero.calibration.is_identity());
    EXPECT_EQ(zero.notes.size(), 1U);
}

TEST(Nrrd, Refusals) {
    const test::TestFolder folder;
    struct Case {
        std::string text;
        ErrorKind kind;
        std::string words;
    };
    const std::string raw = "encoding: raw\n\n";
    const std::vector<Case> cases = {
        {header("longlong", raw), ErrorKind::input, "endian: little"},
        {header("block", raw), ErrorKind::unsupported, "unu convert"},
        {header("shrot", raw), ErrorKind::input, "not a NRRD type"},
        {header("short", raw), ErrorKind::input, "endian: little"},
        {header("short", "endian: middle\n" + raw), ErrorKind::input, "'middle'"},
        {header("uchar", "encoding: zrl\n\n"), ErrorKind::unsupported, "unu save"},
        {header("uchar", "encoding: hex\n\n"), ErrorKind::unsupported, "hex"},
        {header("uchar", "encoding: bzip2\n\n"), ErrorKind::input, "a bzip2 stream"},
        {header("uchar", "encoding: zip\n\n"), ErrorKind::input, "not a NRRD encoding"},
        {header("uchar", "\n"), ErrorKind::input, "encoding"},
        {header("uchar", raw, "5 4"), ErrorKind::input, "has 2 values"},
        {header("uchar", raw, "5 4 0"), ErrorKind::input, "0 samples"},
        {header("uchar", raw, "5 4 -3"), ErrorKind::input, "-3 samples"},
        {header("uchar", raw, "5 4 x"), ErrorKind::input, "'x' is not a number"},
        {header("uchar", raw, "5 4 99999999999999999999"), ErrorKind::input, "is not a number"},
        {header("uchar", raw, "1099511627776 1099511627776 2"), ErrorKind::input, "63 bits"},
        {header("uchar", raw, "1099511627776 4194304 1"), ErrorKind::input, "the file holds"},
        {header("uchar", raw), ErrorKind::input, "the file holds 0 bytes"},
        {header("uchar", "sizes: 5 4 3\n" + raw), ErrorKind::input, "twice"},
        {header("uchar", "kinds: RGB-color domain domain\n" + raw), ErrorKind::unsupported, "unu slice"},
        {header("uchar", "spacings: 1 1\n" + raw), ErrorKind::input, "spacings"},
        {header("uchar", "spacings: 1 1 1\nspace directions: (1,0,0) (0,1,0) (0,0,1)\n" + raw), ErrorKind::input, "one description"},
        {header("uchar", "space directions: (1,0,0) (0,1,0 (0,0,1)\n" + raw), ErrorKind::input, "space directions"},
        {header("uchar", "byte skip: -2\n" + raw), ErrorKind::input, "byte skip"},
        {header("uchar", "byte skip: -1\nencoding: gzip\n\n"), ErrorKind::input, "byte skip"},
        {header("uchar", "byte skip: -1\nencoding: bzip2\n\n"), ErrorKind::input, "byte skip"},
        {header("uchar", "byte skip: 9223372036854775807\n" + raw), ErrorKind::input, "ends early"},
        {header("uchar", "no colon here\n" + raw), ErrorKind::input, "line 6"},
        {header("uchar", "calibration_slope:=two\n" + raw), ErrorKind::input, "'two'"},
        {"NRRD0009\n", ErrorKind::unsupported, "NRRD0009"},
        {"NRRD\n", ErrorKind::input, "NRRD version"},
        {"NRRD0004\ntype: uchar\ndimension: 1\nsizes: 5\n" + raw, ErrorKind::unsupported, "1 axes"},
        {"NRRD0004\ntype: uchar\ndimension: 17\nsizes: 5\n" + raw, ErrorKind::input, "17"},
        {"NRRD0004\ntype: uchar\ndimension: 4\nsizes: 2 2 2 2\nkinds: time space space space\n" + raw, ErrorKind::unsupported,
         "unu permute"},
        {"NRRD0004\ntype: uchar\ndimension: 5\nsizes: 2 2 2 2 2\n" + raw, ErrorKind::unsupported, "5 axes"},
        {"NRRD0004\ntype: uchar\nsizes: 2 2 2 2 2\n" + raw, ErrorKind::input, "dimension"},
        {"NRRD0004\ntype: uchar\ndimension: 3\n" + raw, ErrorKind::input, "sizes"},
        {"NRRD0004\ndimension: 3\nsizes: 1 1 1\n" + raw, ErrorKind::input, "type"},
    };
    for (const Case& c : cases) {
        SCOPED_TRACE(c.text);
        expect_helpful(failure_of_loading(folder.write("v.nrrd", c.text)), c.kind, c.words);
    }
}

TEST(Nrrd, TrailingBytesAndCorruptChecksums) {
    const test::TestFolder folder;
    const std::string samples = test::telling_bytes(60);
    const auto failure = [&](const std::string& encoding, const std::string& payload) {
        return failure_of_loading(folder.write("v.nrrd", header("uchar", "encoding: " + encoding + "\n\n") + payload));
    };
    expect_helpful(failure("raw", samples + "more"), ErrorKind::input, "4 bytes follow");
    for (const std::string encoding : {"gzip", "bzip2"}) {
        SCOPED_TRACE(encoding);
        const std::string packed = encoded(samples, encoding);
        expect_helpful(failure(encoding, encoded(samples + "more", encoding)), ErrorKind::input, "4 bytes follow");
        expect_helpful(failure(encoding, packed + encoded("more", encoding)), ErrorKind::input, "4 bytes follow");
        expect_helpful(failure(encoding, packed + "garbage"), ErrorKind::input, "7 bytes follow");
        std::string damaged = packed;
        damaged[damaged.size() - 6] ^= 1;  // in the CRC; of bzip2: in the mark of the end
        expect_helpful(failure(encoding, damaged), ErrorKind::input, "corrupt");
        expect_helpful(failure(encoding, encoded(samples.substr(1), encoding)), ErrorKind::input, "1 more bytes");
        expect_helpful(failure(encoding, samples), ErrorKind::input, "corrupt");
    }
    expect_helpful(failure("bzip2", test::gzip(samples)), ErrorKind::input, "it does not begin as bzip2 does");
}

TEST(Nrrd, EveryTruncationAndDamagedBitOfBzip2) {
    const test::TestFolder folder;
    const std::string samples = test::telling_bytes(60), start = header("uchar", "encoding: bzip2\n\n");
    for (const std::string& payload : {test::bzip2(samples), test::bzip2(samples.substr(0, 20)) + test::bzip2(samples.substr(20))}) {
        for (std::size_t size = 0; size < payload.size(); ++size) {
            SCOPED_TRACE("cut to " + std::to_string(size));
            expect_helpful(failure_of_loading(folder.write("v.nrrd", start + payload.substr(0, size))), ErrorKind::input, "");
        }
        const std::string path = folder.write("v.nrrd", "");
        int harmless = 0;
        for (std::size_t bit = 0; bit < 8 * payload.size(); ++bit) {
            SCOPED_TRACE("bit " + std::to_string(bit));
            std::string damaged = payload;
            damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ 1 << bit % 8);
            const test::Replaced replaced(path, start + damaged);
            std::string read;
            const test::Failure failure = test::failure_of([&] { read = samples_of(path); });
            if (!failure.message.empty()) {
                expect_helpful(failure, ErrorKind::input, "");
            } else {  // the size of blocks, the padding of the last byte
                EXPECT_EQ(read, samples);
                ++harmless;
            }
        }
        EXPECT_LT(harmless, 40);
    }
}

/// A stream of many blocks; what a few bytes may claim.
TEST(Nrrd, Bzip2OfManyBlocks) {
    const test::TestFolder folder;
    const std::string samples = test::telling_bytes(700'000), zeros(60'000'000, '\0');
    const std::string path = folder.write("v.nrrd", header("uchar", "encoding: bzip2\n\n", "100 100 70") + test::bzip2(samples, 1));
    const auto reader = open_volume(path);
    EXPECT_EQ(test::read_all(*reader, 7), samples);
    const std::string few = test::bzip2(zeros);
    EXPECT_LT(few.size(), 100U);
    const std::string claim = folder.write("w.nrrd", header("uchar", "encoding: bzip2\n\n", "1000 1000 60") + few);
    EXPECT_EQ(samples_of(claim), zeros);
    expect_helpful(failure_of_loading(folder.write("w.nrrd", header("uchar", "encoding: bzip2\n\n", "1000 1000 999999") + few)),
                   ErrorKind::input, "cannot hold more");
}

}  // namespace
}  // namespace isoatlas
