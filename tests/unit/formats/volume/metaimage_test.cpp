// MetaImage: every variant of the same samples reads to the same bytes; geometry and refusals.
#include <gtest/gtest.h>

#include "unit/formats/volume/volume_files.h"

namespace isoatlas {
namespace {

using test::expect_helpful;
using test::failure_of_loading;

struct MetaType {
    const char* spelling;
    ValueType type;
};
constexpr MetaType kTypes[] = {{"MET_UCHAR", ValueType::u8},  {"MET_CHAR", ValueType::i8},  {"MET_USHORT", ValueType::u16},
                               {"MET_SHORT", ValueType::i16}, {"MET_UINT", ValueType::u32}, {"MET_INT", ValueType::i32},
                               {"MET_ULONG", ValueType::u32}, {"MET_LONG", ValueType::i32}, {"MET_FLOAT", ValueType::f32},
                               {"MET_DOUBLE", ValueType::f64}};

std::string header(const std::string& type, const std::string& more, const std::string& file = "LOCAL") {
    return "ObjectType = Image\nNDims = 3\nDimSize = 5 4 3\nElementType = " + type + "\n" + more + "ElementDataFile = " + file + "\n";
}

std::string samples_of(const std::string& path) { return test::text_of_bytes(load_volume(path)); }

TEST(MetaImage, EveryTypeEndianAndCompression) {
    const test::TestFolder folder;
    for (const MetaType& type : kTypes) {
        SCOPED_TRACE(type.spelling);
        const std::size_t bytes = size_of(type.type);
        const std::string samples = test::telling_bytes(60 * bytes), big = test::swapped(samples, bytes);
        const std::string packed = test::zlib(samples);
        const std::vector<std::pair<std::string, std::string>> files = {
            {"BinaryData = True\n", samples},
            {"BinaryDataByteOrderMSB = False\n", samples},
            {"BinaryDataByteOrderMSB = True\n", big},
            {"ElementByteOrderMSB = True\n", big},
            {"CompressedData = True\nCompressedDataSize = " + std::to_string(packed.size()) + "\n", packed},
            {"CompressedData = True\n", packed},
            {"CompressedData = True\n", test::gzip(samples)},
            {"CompressedData = True\nElementByteOrderMSB = True\n", test::zlib(big)},
            {"HeaderSize = -1\n", "something first" + samples}};
        for (const auto& [more, payload] : files) {
            SCOPED_TRACE(more);
            const std::string path = folder.write("v.mha", header(type.spelling, more) + payload);
            const auto reader = open_volume(path);
            EXPECT_EQ(reader->info().type, type.type);
            EXPECT_EQ(reader->info().slab_readable, more.find("Compressed") == std::string::npos);
            EXPECT_EQ(reader->info().file_bytes, static_cast<std::int64_t>(std::filesystem::file_size(path)));
            for (std::int64_t slices = 1; slices <= 3; ++slices) EXPECT_EQ(test::read_all(*reader, slices), samples);
            const bool guessed = bytes > 1 && more.find("ByteOrder") == std::string::npos;
            EXPECT_EQ(reader->info().notes.size(), guessed ? 1U : 0U);
        }
    }
}

TEST(MetaImage, DetachedListsAndSeries) {
    const test::TestFolder folder;
    const std::string samples = test::telling_bytes(120);
    folder.write("v.raw", samples);
    folder.write("with header.raw", "headerheader" + samples);
    folder.write("v.zraw", test::zlib(samples));
    for (int i = 0; i < 3; ++i) {
        folder.write("s" + std::to_string(i + 1) + ".raw", samples.substr(static_cast<std::size_t>(i) * 40, 40));
        folder.write("s" + std::to_string(i + 1) + ".z", test::zlib(samples.substr(static_cast<std::size_t>(i) * 40, 40)));
    }
    const std::vector<std::string> headers = {header("MET_SHORT", "", "v.raw"),
                                              header("MET_SHORT", "HeaderSize = 12\n", "with header.raw"),
                                              header("MET_SHORT", "HeaderSize = -1\n", "with header.raw"),
                                              header("MET_SHORT", "CompressedData = True\n", "v.zraw"),
                                              header("MET_SHORT", "", "s%d.raw 1 3 1"),
                                              header("MET_SHORT", "", "s%1d.raw 1 3"),
                                              header("MET_SHORT", "CompressedData = True\n", "s%d.z 1 3 1"),
                                              header("MET_SHORT", "", "LIST\ns1.raw\ns2.raw\ns3.raw"),
                                              header("MET_SHORT", "", "LIST 2\ns1.raw\r\ns2.raw\r\n\r\ns3.raw")};
    for (const std::string& text : headers) {
        SCOPED_TRACE(text);
        const std::string path = folder.write("v.mhd", text);
        EXPECT_EQ(samples_of(path), samples);
        EXPECT_EQ(test::read_all(*open_volume(path), 2), samples);
    }
    const auto failing = [&](const std::string& more, const std::string& file) {
        return failure_of_loading(folder.write("v.mhd", header("MET_SHORT", more, file)));
    };
    expect_helpful(failing("", "missing.raw"), ErrorKind::input, "missing.raw");
    expect_helpful(failing("", "LIST"), ErrorKind::input, "empty");
    expect_helpful(failing("", ""), ErrorKind::input, "ElementDataFile");
    expect_helpful(failing("", "s%d.raw 1 4 1"), ErrorKind::input, "s4.raw");
    expect_helpful(failing("", "s%d.raw 1 1000000000000 1"), ErrorKind::input, "evenly");
    expect_helpful(failing("HeaderSize = 100\n", "v.raw"), ErrorKind::input, "the file holds 20 bytes");
}

TEST(MetaImage, LocalHeaderSizeCountsFromTheStart) {
    const test::TestFolder folder;
    const std::string samples = test::telling_bytes(60);
    const std::string text = header("MET_UCHAR", "HeaderSize = 200\n");
    const std::string path = folder.write("v.mha", text + std::string(200 - text.size(), '.') + samples);
    EXPECT_EQ(samples_of(path), samples);
    expect_helpful(failure_of_loading(folder.write("v.mha", header("MET_UCHAR", "HeaderSize = 20\n") + samples)), ErrorKind::input,
                   "inside this header");
}

TEST(MetaImage, TextSamples) {
    const test::TestFolder folder;
    const std::string path = folder.write(
        "v.mha", "NDims = 2\nDimSize = 2 2\nElementType = MET_SHORT\nBinaryData = False\nElementDataFile = LOCAL\n1 -2\n3 400\n");
    EXPECT_EQ(samples_of(path), test::bytes_of<std::int16_t>({1, -2, 3, 400}));
}

Geometry geometry_of(const std::string& more) {
    const test::TestFolder folder;
    return open_volume(folder.write("v.mha", header("MET_UCHAR", more) + std::string(60, 'x')))->info().geometry;
}

TEST(MetaImage, Geometry) {
    // Axis 0 runs along physical y, axis 1 along z, axis 2 along x: rows of the matrix are axes.
    const Geometry turned =
        geometry_of("TransformMatrix = 0 1 0 0 0 1 1 0 0\nOffset = 1 2 3\nElementSpacing = 4 5 6\nAnatomicalOrientation = RAI\n");
    EXPECT_EQ(to_physical(turned, {1, 0, 0}), (Vec3{1, 6, 3}));
    EXPECT_EQ(to_physical(turned, {0, 1, 0}), (Vec3{1, 2, 8}));
    EXPECT_EQ(to_physical(turned, {0, 0, 1}), (Vec3{7, 2, 3}));
    EXPECT_EQ(turned.space, "LPS");
    const Geometry old = geometry_of("Position = 1 2 3\nElementSize = 4 5 6\nDistanceUnits = mm\n");
    EXPECT_EQ(old.spacing, (Vec3{4, 5, 6}));
    EXPECT_EQ(old.origin, (Vec3{1, 2, 3}));
    EXPECT_EQ(old.unit, "mm");
    EXPECT_EQ(old.space, "unknown");
    EXPECT_EQ(geometry_of("AnatomicalOrientation = ???\n").space, "unknown");
    EXPECT_EQ(geometry_of("TransformMatrix = 1 0 0 1 0 0 0 0 1\n").direction, Geometry{}.direction);
}

TEST(MetaImage, TwoAndFourDimensions) {
    const test::TestFolder folder;
    const std::string samples = test::telling_bytes(24);
    const std::string flat =
        folder.write("flat.mha",
                     "NDims = 2\nDimSize = 6 4\nTransformMatrix = 0 1 -1 0\nElementSpacing = 2 3\nElementType = MET_UCHAR\n"
                     "ElementToIntensityFunctionSlope = 2\nElementDataFile = LOCAL\n" +
                         samples);
    const auto reader = open_volume(flat);
    EXPECT_EQ(reader->info().extent, (Extent{2, {6, 4, 1}}));
    EXPECT_EQ(reader->info().geometry.direction, (Mat3{{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}}));
    EXPECT_EQ(reader->info().calibration, (Calibration{2, 0}));
    const std::string series =
        folder.write("series.mha", "NDims = 4\nDimSize = 1 2 3 4\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n" + samples);
    expect_reason(failure_of_loading(series), ErrorKind::usage, Reason::time_step_needed, "3");
    for (std::int64_t step = 0; step < 4; ++step) {
        OpenOptions options;
        options.time_step = step;
        EXPECT_EQ(test::text_of_bytes(load_volume(series, options)), samples.substr(static_cast<std::size_t>(step) * 6, 6));
    }
}

TEST(MetaImage, Refusals) {
    const test::TestFolder folder;
    const std::string packed = test::zlib(std::string(60, 'x'));
    struct Case {
        std::string text;
        ErrorKind kind;
        std::string words;
    };
    const std::vector<Case> cases = {
        {header("MET_STRING", ""), ErrorKind::unsupported, "MET_DOUBLE"},
        {header("MET_FLOAT_ARRAY", ""), ErrorKind::unsupported, "MET_FLOAT_ARRAY"},
        {header("MET_FLOOT", ""), ErrorKind::input, "not a MetaImage type"},
        {header("MET_UCHAR", "ElementNumberOfChannels = 3\n"), ErrorKind::unsupported, "3 values"},
        {header("MET_UCHAR", "DimSize = 5 4 3\n"), ErrorKind::input, "twice"},
        {header("MET_UCHAR", "BinaryData = Maybe\n"), ErrorKind::input, "Maybe"},
        {header("MET_UCHAR", "BinaryData = False\nCompressedData = True\n"), ErrorKind::input, "CompressedData"},
        {header("MET_UCHAR", "BinaryDataByteOrderMSB = True\nElementByteOrderMSB = False\n"), ErrorKind::input, "contradicts"},
        {header("MET_UCHAR", "ElementSpacing = 1 1\n"), ErrorKind::input, "has 2 values"},
        {header("MET_UCHAR", "TransformMatrix = 1 0 0 1\n"), ErrorKind::input, "has 4 values"},
        {header("MET_UCHAR", "Offset = 1 2 nan\n"), ErrorKind::input, "not finite"},
        {header("MET_UCHAR", "what is this\n"), ErrorKind::input, "line 5"},
        {header("MET_UCHAR", "HeaderSize = -2\n"), ErrorKind::input, "HeaderSize"},
        {header("MET_UCHAR", ""), ErrorKind::input, "the file holds 0 bytes"},
        {header("MET_UCHAR", "CompressedData = True\nCompressedDataSize = -4\n") + packed, ErrorKind::input, "negative"},
        {header("MET_UCHAR", "CompressedData = True\nCompressedDataSize = 4000\n") + packed, ErrorKind::input, "truncated"},
        {header("MET_UCHAR", "CompressedData = True\n") + packed.substr(0, packed.size() - 5), ErrorKind::input, "ends early"},
        {"ObjectType = Tube\nNDims = 3\nElementDataFile = LOCAL\n", ErrorKind::unsupported, "Tube"},
        {"ObjectType = Image\nNDims = 3\n", ErrorKind::input, "ElementDataFile"},
        {"ObjectType = Image\nNDims = 5\nDimSize = 1 1 1 1 1\nElementType = MET_UCHAR\nElementDataFile = LOCAL\nx", ErrorKind::unsupported,
         "5 axes"},
        {"ObjectType = Image\nNDims = 0\nElementDataFile = LOCAL\nx", ErrorKind::input, "NDims"},
        {"NDims = 2\nDimSize = 0 4\nElementType = MET_UCHAR\nElementDataFile = LOCAL\nx", ErrorKind::input, "0 samples"},
        {"NDims = 2\nDimSize = 1099511627776 1099511627776\nElementType = MET_UCHAR\nElementDataFile = LOCAL\nx", ErrorKind::input,
         "63 bits"},
        {"NDims = 2\nDimSize = 1099511627776 1048576\nElementType = MET_UCHAR\nElementDataFile = LOCAL\nx", ErrorKind::input,
         "the file holds 1 bytes"},
        {"NDims = 2\nElementType = MET_UCHAR\nElementDataFile = LOCAL\nx", ErrorKind::input, "DimSize"},
        {"NDims = 2\nDimSize = 1 1\nElementDataFile = LOCAL\nx", ErrorKind::input, "ElementType"},
        {"ObjectType = Image\nDimSize = 1 1\nElementDataFile = LOCAL\nx", ErrorKind::input, "NDims"},
    };
    for (const Case& c : cases) {
        SCOPED_TRACE(c.text);
        expect_helpful(failure_of_loading(folder.write("v.mha", c.text)), c.kind, c.words);
    }
}

}  // namespace
}  // namespace isoatlas
