// VTK XML: formats, byte orders, header types, blocks of zlib and LZ4, geometry, choice of arrays, damage.
#include <gtest/gtest.h>
#include <lz4.h>

#include <cstring>
#include "unit/formats/volume/hostile_files.h"
#include "unit/formats/volume/volume_files.h"

namespace isoatlas {
namespace {

using namespace test;

/// How the samples are stored.
struct Storage {
    std::string format = "appended";  ///< ascii, binary, appended
    bool raw = true;                  ///< appended: raw or base64
    bool big = false, wide = false;
    std::string packed = "";  ///< ZLib, LZ4
    std::string text() const { return format + (raw ? " raw " : " base64 ") + (big ? "big " : "") + (wide ? "wide " : "") + packed; }
};

const char* type_name(ValueType type) {
    static constexpr const char* kNames[] = {"UInt8", "Int8", "UInt16", "Int16", "UInt32", "Int32", "Float32", "Float64"};
    return kNames[static_cast<int>(type)];
}

std::string word(std::uint64_t value, const Storage& s) {
    std::string bytes(reinterpret_cast<const char*>(&value), s.wide ? 8 : 4);
    if (s.big) std::reverse(bytes.begin(), bytes.end());
    return bytes;
}

std::string lz4(const std::string& plain) {
    const int size = static_cast<int>(plain.size());
    std::string out(static_cast<std::size_t>(LZ4_compressBound(size)), '\0');
    out.resize(static_cast<std::size_t>(LZ4_compress_default(plain.data(), out.data(), size, LZ4_compressBound(size))));
    return out;
}

/// The array as it stands in the file: ascii, or header and data (blocks of 20 bytes when packed).
std::string encode(const Storage& s, ValueType type, const std::string& samples) {
    const std::string data = s.big ? swapped(samples, size_of(type)) : samples;
    const bool coded = s.format == "binary" || !s.raw;
    if (s.packed.empty()) return coded ? base64(word(data.size(), s) + data) : word(data.size(), s) + data;
    constexpr std::size_t kBlock = 20;
    const std::size_t count = (data.size() + kBlock - 1) / kBlock;
    std::string header = word(count, s) + word(kBlock, s) + word(data.size() % kBlock, s), blocks;
    for (std::size_t i = 0; i < count; ++i) {
        const std::string plain = data.substr(i * kBlock, kBlock), block = s.packed == "LZ4" ? lz4(plain) : zlib(plain);
        header += word(block.size(), s);
        blocks += block;
    }
    return coded ? base64(header) + base64(blocks) : header + blocks;
}

std::string ascii_of(ValueType type, const std::string& samples) {
    Volume volume = make_volume({.rank = 3, .size = {static_cast<std::int64_t>(samples.size() / size_of(type)), 1, 1}}, type);
    std::memcpy(volume.bytes.data(), samples.data(), samples.size());
    std::string text;
    for (std::int64_t i = 0; i < volume.info.extent.size[0]; ++i) {
        char number[64];
        std::snprintf(number, sizeof number, type == ValueType::f32 ? "%.9g " : "%.17g ", volume.value(i));
        text += number;
        if (i % 6 == 5) text += "\n        ";
    }
    return text;
}

const char* const kImage = "<ImageData WholeExtent=\"0 3 0 2 0 1\" Origin=\"0 0 0\" Spacing=\"1 1 1\">";
const char* const kPiece = "<Piece Extent=\"0 3 0 2 0 1\"><PointData Scalars=\"v\">";

std::string file_around(const Storage& s, const std::string& grid, const std::string& piece, const std::string& arrays,
                        const std::string& appended) {
    const std::string type = grid.substr(1, grid.find_first_of(" >") - 1);
    std::string text = "<?xml version=\"1.0\"?>\n<!-- a <DataArray> in a comment -->\n<VTKFile type=\"" + type +
                       "\" version=\"1.0\" byte_order=\"" + (s.big ? "BigEndian" : "LittleEndian") + "\" header_type=\"" +
                       (s.wide ? "UInt64" : "UInt32") + "\"" +
                       (s.packed.empty() ? "" : " compressor=\"vtk" + s.packed + "DataCompressor\"") + ">\n " + grid + "\n" + piece +
                       arrays + "</PointData></Piece></" + type + ">\n";
    if (!appended.empty())
        text += std::string(" <AppendedData encoding=\"") + (s.raw ? "raw" : "base64") + "\">\n  _" + appended + "\n </AppendedData>\n";
    return text + "</VTKFile>\n";
}

std::string array_tag(const std::string& name, const char* type, const Storage& s, const std::string& more = "") {
    return "<DataArray type=\"" + std::string(type) + "\" Name=\"" + name + "\" format=\"" + s.format + "\" " + more;
}

std::string vti(const Storage& s, ValueType type, const std::string& samples, const std::string& grid = kImage,
                const std::string& piece = kPiece) {
    const std::string tag = array_tag("v", type_name(type), s);
    if (s.format == "appended") return file_around(s, grid, piece, tag + " offset=\"0\"/>", encode(s, type, samples));
    return file_around(s, grid, piece,
                       tag + ">\n" + (s.format == "ascii" ? ascii_of(type, samples) : encode(s, type, samples)) + "\n</DataArray>", "");
}

std::vector<Storage> all_storages() {
    std::vector<Storage> storages;
    for (const bool big : {false, true}) {
        storages.push_back({.format = "ascii", .big = big});
        for (const bool wide : {false, true}) {
            for (const char* packed : {"", "ZLib", "LZ4"}) {
                storages.push_back({.format = "binary", .raw = false, .big = big, .wide = wide, .packed = packed});
                for (const bool raw : {false, true})
                    storages.push_back({.format = "appended", .raw = raw, .big = big, .wide = wide, .packed = packed});
            }
        }
    }
    return storages;
}

TEST(Vti, EveryTypeAndStorage) {
    const TestFolder folder;
    for (int t = 0; t < 8; ++t) {
        const ValueType type = static_cast<ValueType>(t);
        const std::string samples = telling_bytes(24 * size_of(type));
        for (const Storage& s : all_storages()) {
            SCOPED_TRACE(std::string(name_of(type)) + " " + s.text());
            const std::string path = folder.write("v.vti", vti(s, type, samples));
            const auto reader = open_volume(path);
            ASSERT_EQ(reader->info().type, type);
            ASSERT_EQ(reader->info().extent, (Extent{.rank = 3, .size = {4, 3, 2}}));
            ASSERT_EQ(reader->info().slab_readable, s.format == "appended" && s.raw);
            ASSERT_EQ(read_all(*reader, 2), samples);
            ASSERT_EQ(reader->info().notes.size(), 0U) << reader->info().notes[0];
            expect_slabs_equal_whole(path);
        }
    }
}

/// One block of more than a megabyte is decompressed as it is read: forwards, backwards, to its checksum.
TEST(Vti, OneLargeBlock) {
    const TestFolder folder;
    constexpr std::uint64_t kSide = 128;
    std::string samples(kSide * kSide * kSide, '\0');
    std::uint32_t state = 1;
    for (char& sample : samples) sample = static_cast<char>((state = state * 1664525 + 1013904223) >> 28);
    const std::string extent = "0 127 0 127 0 127";
    const auto file = [&](std::string block, std::uint64_t bytes) {
        std::string words;
        for (const std::uint64_t word : {std::uint64_t{1}, bytes, std::uint64_t{0}, std::uint64_t{block.size()}}) {
            for (int i = 0; i < 8; ++i) words += static_cast<char>(word >> (8 * i));
        }
        return "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\" "
               "compressor=\"vtkZLibDataCompressor\">\n<ImageData WholeExtent=\"" +
               extent + "\" Origin=\"0 0 0\" Spacing=\"1 1 1\"><Piece Extent=\"" + extent +
               "\">\n<PointData Scalars=\"s\"><DataArray type=\"UInt8\" Name=\"s\" format=\"appended\" "
               "offset=\"0\"/></PointData></Piece></ImageData>\n"
               "<AppendedData encoding=\"raw\">_" +
               words + block + "</AppendedData></VTKFile>";
    };
    const std::string block = zlib(samples);
    const std::string path = folder.write("v.vti", file(block, samples.size()));
    ASSERT_EQ(read_all(*open_volume(path), 5), samples);
    const auto reader = open_volume(path);
    for (const std::int64_t z : {std::int64_t{100}, std::int64_t{3}, std::int64_t{127}, std::int64_t{0}}) {
        std::vector<std::byte> slice(kSide * kSide);
        reader->read(z, z + 1, slice);
        ASSERT_EQ(std::memcmp(slice.data(), samples.data() + z * kSide * kSide, slice.size()), 0) << z;
    }
    const auto refused = [&](const std::string& bytes) {
        try {
            (void)read_all(*open_volume(folder.write("bad.vti", file(bytes, samples.size()))), 5);
            return false;
        } catch (const Error& error) {
            return error.kind() == ErrorKind::input;
        }
    };
    std::string flipped = block;
    flipped.back() = static_cast<char>(flipped.back() ^ 1);  // of the checksum
    EXPECT_TRUE(refused(flipped));
    flipped = block;
    flipped[block.size() / 2] = static_cast<char>(flipped[block.size() / 2] ^ 4);
    EXPECT_TRUE(refused(flipped));
    EXPECT_TRUE(refused(block.substr(0, block.size() - 3)));
    EXPECT_TRUE(refused(zlib(samples + "x")));
    EXPECT_TRUE(refused(zlib(samples.substr(1))));
}

/// Samples that look like XML must not be parsed.
TEST(Vti, AppendedBytesAreNotXml) {
    const TestFolder folder;
    std::string samples = "</VTKFile><AppendedData>_&amp;<!--";
    samples.resize(24 * 4, '<');
    EXPECT_EQ(read_all(*open_volume(folder.write("v.vti", vti({}, ValueType::u32, samples))), 1), samples);
}

TEST(Vti, Geometry) {
    const TestFolder folder;
    const std::string samples = telling_bytes(24);
    const auto info = [&](const std::string& grid, const std::string& piece = kPiece) {
        return open_volume(folder.write("v.vti", vti({}, ValueType::u8, samples, grid, piece)))->info();
    };
    const auto piece = [](const std::string& extent) { return "<Piece Extent=\"" + extent + "\"><PointData Scalars=\"v\">"; };
    EXPECT_EQ(info("<ImageData WholeExtent=\"0 3 0 2 0 1\" Origin=\"1 2 3\" Spacing=\"0.5 2 4\">").geometry,
              (Geometry{.spacing = {0.5, 2, 4}, .origin = {1, 2, 3}, .unit = {}}));
    // An extent that does not begin at 0 moves the first sample.
    EXPECT_EQ(
        info("<ImageData WholeExtent=\"10 13 -2 0 5 6\" Origin=\"1 2 3\" Spacing=\"0.5 2 4\">", piece("10 13 -2 0 5 6")).geometry.origin,
        (Vec3{6, -2, 23}));
    const VolumeInfo turned =
        info("<ImageData WholeExtent=\"1 4 0 2 0 1\" Origin=\"0 0 0\" Spacing=\"2 3 4\" Direction=\"0 -1 0 1 0 0 0 0 1\">",
             piece("1 4 0 2 0 1"));
    EXPECT_EQ(turned.geometry,
              (Geometry{.spacing = {2, 3, 4}, .origin = {0, 2, 0}, .direction = {{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}}, .unit = {}}));
    EXPECT_EQ(info("<ImageData WholeExtent=\"0 3 0 2 0 1\" Spacing=\"-2 1 1\">").geometry,
              (Geometry{.spacing = {2, 1, 1}, .direction = {{{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, .unit = {}}));
    EXPECT_EQ(info("<ImageData WholeExtent=\"0 7 0 2 0 1\">").notes.size(), 1U);  // the piece is a part
    const VolumeInfo flat = info("<ImageData WholeExtent=\"0 7 0 2 4 4\">", piece("0 7 0 2 4 4"));
    EXPECT_EQ(flat.extent, (Extent{.rank = 2, .size = {8, 3, 1}}));
    EXPECT_EQ(flat.notes.size(), 1U);
}

TEST(Vti, CellsBecomeSamples) {
    const TestFolder folder;
    const std::string grid = "<ImageData WholeExtent=\"0 4 0 3 0 2\" Origin=\"0 0 0\" Spacing=\"2 1 1\">",
                      piece = "<Piece Extent=\"0 4 0 3 0 2\"><CellData><DataArray type=\"UInt8\" Name=\"c\" format=\"ascii\">";
    std::string numbers;
    for (int i = 0; i < 24; ++i) numbers += std::to_string(i) + " ";
    const auto reader =
        open_volume(folder.write("v.vti", file_around({}, grid, piece, numbers + "</DataArray></CellData><PointData>", "")));
    EXPECT_EQ(reader->info().extent, (Extent{.rank = 3, .size = {4, 3, 2}}));
    EXPECT_EQ(reader->info().geometry.origin, (Vec3{1, 0.5, 0.5}));
    EXPECT_EQ(reader->info().notes.size(), 1U);
    EXPECT_EQ(read_all(*reader, 1)[23], 23);
}

TEST(Vti, ChoiceOfTheArray) {
    const TestFolder folder;
    const Storage ascii{.format = "ascii"};
    const std::string a = array_tag("a", "UInt8", ascii) + ">" + ascii_of(ValueType::u8, std::string(24, 'a')) + "</DataArray>";
    const std::string v = array_tag("v", "UInt8", ascii) + ">" + ascii_of(ValueType::u8, std::string(24, 'v')) + "</DataArray>";
    const std::string vector =
        array_tag("w", "UInt8", ascii, "NumberOfComponents=\"3\"") + ">" + ascii_of(ValueType::u8, std::string(72, 'w')) + "</DataArray>";
    const auto first = [&](const std::string& arrays, std::size_t notes) {
        const auto reader = open_volume(folder.write("v.vti", file_around(ascii, kImage, kPiece, arrays, "")));
        EXPECT_EQ(reader->info().notes.size(), notes);
        return read_all(*reader, 2)[0];
    };
    EXPECT_EQ(first(a + v, 1), 'v');
    EXPECT_EQ(first(vector + a, 0), 'a');
    EXPECT_EQ(first(a, 0), 'a');
    expect_helpful(failure_of_loading(folder.write("v.vti", file_around(ascii, kImage, kPiece, vector, ""))), ErrorKind::unsupported,
                   "vectors");
    expect_helpful(failure_of_loading(folder.write("v.vti", file_around(ascii, kImage, kPiece, "", ""))), ErrorKind::input,
                   "no data array");
}

TEST(Vti, RectilinearGrids) {
    const TestFolder folder;
    const std::string samples = telling_bytes(48);
    for (const Storage& s : all_storages()) {
        if (s.format == "appended") continue;
        const auto line = [&](const std::string& name, const std::vector<double>& values) {
            const std::string bytes = bytes_of(values);
            return array_tag(name, "Float64", s) + ">" +
                   (s.format == "ascii" ? ascii_of(ValueType::f64, bytes) : encode(s, ValueType::f64, bytes)) + "</DataArray>";
        };
        const auto grid = [&](const std::vector<double>& x) {
            const std::string piece = "<Piece Extent=\"0 3 0 2 0 1\"><Coordinates>" + line("x", x) + line("y", {-1, 0, 5}) +
                                      line("z", {0, 0.5}) + "</Coordinates><PointData Scalars=\"v\">";
            return folder.write("v.vtr", vti(s, ValueType::u16, samples, "<RectilinearGrid WholeExtent=\"0 3 0 2 0 1\">", piece));
        };
        SCOPED_TRACE(s.text());
        const auto reader = open_volume(grid({0, 1, 2.5, 7}));
        EXPECT_EQ(reader->info().geometry.coordinates, (std::array<std::vector<double>, 3>{{{0, 1, 2.5, 7}, {-1, 0, 5}, {0, 0.5}}}));
        EXPECT_EQ(read_all(*reader, 2), samples);
        expect_helpful(failure_of_loading(grid({0, 1, 1, 7})), ErrorKind::unsupported, "ascend");
        if (s.format != "ascii") expect_helpful(failure_of_loading(grid({0, 1, 2})), ErrorKind::input, "24 bytes");
    }
}

TEST(Vti, WhatIsNotRead) {
    const TestFolder folder;
    const std::string samples = telling_bytes(24), good = vti({}, ValueType::u8, samples);
    const auto failure = [&](const std::string& from, const std::string& to, std::string text) {
        text.replace(text.find(from), from.size(), to);
        return failure_of_loading(folder.write("v.vti", text));
    };
    expect_helpful(failure("type=\"ImageData\"", "type=\"PolyData\"", good), ErrorKind::unsupported, "PolyData");
    expect_helpful(failure("type=\"ImageData\"", "type=\"PImageData\"", good), ErrorKind::unsupported, "PImageData");
    expect_helpful(failure("\"UInt8\"", "\"Bit\"", good), ErrorKind::unsupported, "Bit");
    expect_helpful(failure("</Piece>", "</Piece><Piece Extent=\"0 1 0 1 0 1\"/>", good), ErrorKind::unsupported, "several pieces");
    expect_helpful(failure("version=\"1.0\" ", "version=\"1.0\" compressor=\"vtkLZMADataCompressor\" ", good), ErrorKind::unsupported,
                   "LZMA");
    expect_helpful(failure("WholeExtent=\"0 3 0 2 0 1\"", "WholeExtent=\"0 3 0 2\"", good), ErrorKind::input, "WholeExtent");
    expect_helpful(failure("Piece Extent=\"0 3 0 2 0 1\"", "Piece Extent=\"0 999999999 0 999999999 0 1\"", good), ErrorKind::input,
                   "bytes");
    expect_helpful(failure("Piece Extent=\"0 3 0 2 0 1\"", "Piece Extent=\"0 999999999999 0 999999999999 0 1\"", good), ErrorKind::input,
                   "63 bits");
    expect_helpful(failure("Spacing=\"1 1 1\"", "Spacing=\"1 nan 1\"", good), ErrorKind::input, "Spacing");
    expect_helpful(failure("offset=\"0\"", "offset=\"4711\"", good), ErrorKind::input, "4711");
    expect_helpful(failure("offset=\"0\"", "offset=\"1\"", good), ErrorKind::input, "bytes");
    expect_helpful(failure(">_", ">?", good.substr(0, good.find("<AppendedData")) + "<AppendedData encoding=\"raw\">_"), ErrorKind::input,
                   "'_'");
    expect_helpful(failure("PointData Scalars", "PointDate Scalars", good), ErrorKind::input, "XML");
    const std::string ascii = vti({.format = "ascii"}, ValueType::u8, samples);
    expect_helpful(failure("format=\"ascii\" >\n", "format=\"ascii\" >\nx", ascii), ErrorKind::input, "");
    expect_helpful(failure("format=\"ascii\" >\n", "format=\"ascii\" >\n999 ", ascii), ErrorKind::input, "999");
    const std::string coded = vti({.format = "binary", .raw = false}, ValueType::u8, samples);
    expect_helpful(failure("format=\"binary\" >\n", "format=\"binary\" >\n*", coded), ErrorKind::input, "base64");
}

TEST(Vti, Damage) {
    const std::string samples = telling_bytes(48);
    for (const Storage& s : {Storage{}, Storage{.packed = "ZLib"}, Storage{.packed = "LZ4"}, Storage{.raw = false},
                             Storage{.format = "ascii"}, Storage{.format = "binary", .raw = false, .wide = true, .packed = "ZLib"}}) {
        SCOPED_TRACE(s.text());
        const std::string content = vti(s, ValueType::u16, samples);
        // The end tags behind appended data are not needed.
        const std::size_t needed =
            s.format == "appended" ? content.find("\n </AppendedData>") : content.find("</VTKFile>") + std::string("</VTKFile>").size();
        expect_truncations_refused("v.vti", content, needed);
        expect_bit_flips_harmless("v.vti", content, 0, std::string::npos, 1032);
    }
}

}  // namespace
}  // namespace isoatlas
