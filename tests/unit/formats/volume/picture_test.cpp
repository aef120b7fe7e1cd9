// PNG, JPEG and BMP slices: colour tables, interlaced rows, folders, damaged and forged files.
#include <gtest/gtest.h>
#include <zlib.h>

#include <filesystem>

#include "formats/volume/picture.h"
#include "unit/formats/volume/hostile_files.h"

namespace isoatlas {
namespace {

using namespace test;

std::string big_word(std::uint32_t value) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 255);
    return bytes;
}
std::string little(std::uint32_t value, std::size_t bytes) {
    std::string text;
    for (std::size_t i = 0; i < bytes; ++i) text += static_cast<char>(value >> 8 * i & 255);
    return text;
}

std::string chunk(const std::string& kind, const std::string& data) {
    const std::string body = kind + data;
    const auto sum = crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
    return big_word(static_cast<std::uint32_t>(data.size())) + body + big_word(static_cast<std::uint32_t>(sum));
}

struct PngRecipe {
    std::uint32_t width = 5, height = 4;
    int depth = 8, colour = 0, row_bytes = 5;
    std::string chunks{};  ///< in front of the pixels
};
std::string png(const PngRecipe& r, const std::string& samples) {
    std::string rows;
    for (std::size_t at = 0; at < samples.size(); at += static_cast<std::size_t>(r.row_bytes))
        rows += '\0' + samples.substr(at, static_cast<std::size_t>(r.row_bytes));
    const std::string header =
        big_word(r.width) + big_word(r.height) + static_cast<char>(r.depth) + static_cast<char>(r.colour) + std::string(3, '\0');
    return "\x89PNG\r\n\x1a\n" + chunk("IHDR", header) + r.chunks + chunk("IDAT", compress(rows, 15)) + chunk("IEND", "");
}

/// 24 bits a pixel unless a table is given.
std::string bmp(std::int32_t width, std::int32_t height, const std::string& pixels, const std::string& table = "",
                std::uint32_t bits = 24) {
    const auto begin = static_cast<std::uint32_t>(54 + table.size());
    const std::string header = little(40, 4) + little(static_cast<std::uint32_t>(width), 4) +
                               little(static_cast<std::uint32_t>(height), 4) + little(1, 2) + little(bits, 2) + little(0, 4) +
                               little(0, 4) + little(10000, 4) + little(5000, 4) + little(static_cast<std::uint32_t>(table.size() / 4), 4) +
                               little(0, 4);
    return "BM" + little(begin + static_cast<std::uint32_t>(pixels.size()), 4) + little(0, 4) + little(begin, 4) + header + table + pixels;
}

/// 16 x 8 grey levels.
std::string jpeg() {
    constexpr std::string_view kHex =
        "ffd8ffe000104a46494600010100000100010000ffdb0043001b12141714111b1716171e1c1b2028422b28252528513a3d3042605565645f555d5b6a"
        "7899816a7190735b5d85b586909ea3abadab6780bcc9baa6c799a8aba4ffc0000b080008001001011100ffc400150001010000000000000000000000"
        "0000000203ffc40017100003010000000000000000000000000000020562ffda0008010100003f000b0b0556160fffd9";
    std::string bytes;
    for (std::size_t i = 0; i + 1 < kHex.size(); i += 2) bytes += static_cast<char>(std::stoi(std::string(kHex.substr(i, 2)), nullptr, 16));
    return bytes;
}

std::string loaded(const std::string& path, const OpenOptions& options = {}) {
    const auto reader = open_volume(path, options);
    return read_all(*reader, 1);
}

OpenOptions channel(const std::string& name) {
    OpenOptions options;
    options.channel = name;
    return options;
}

TEST(Picture, KnownByContent) {
    const auto kind = [](const std::string& bytes) { return picture_kind(std::as_bytes(std::span(bytes))); };
    EXPECT_EQ(kind(png({}, telling_bytes(20))), PictureKind::png);
    EXPECT_EQ(kind(jpeg()), PictureKind::jpeg);
    EXPECT_EQ(kind(bmp(1, 1, "abcd")), PictureKind::bmp);
    for (const char* other : {"", "BM", "BM0123456789012345678", "\x89PNG", "\xff\xd8\xff"}) EXPECT_FALSE(kind(other).has_value()) << other;
}

TEST(Picture, SamplesOf16BitsInEitherByteOrder) {
    const TestFolder folder;
    const std::string samples = telling_bytes(40);
    const std::string path = folder.write("v", png({.depth = 16, .row_bytes = 10}, swapped(samples, 2)));
    EXPECT_EQ(open_volume(path)->info().type, ValueType::u16);
    EXPECT_EQ(loaded(path), samples);
}

TEST(Picture, ColourTables) {
    const TestFolder folder;
    const std::string indices("\x00\x01\x02\x00\x01\x02", 6);
    const PngRecipe colours{.width = 3, .height = 2, .colour = 3, .row_bytes = 3, .chunks = chunk("PLTE", "abcdefghi")};
    std::string path = folder.write("v", png(colours, indices));
    EXPECT_EQ(loaded(path, channel("red")), "adgadg");
    EXPECT_EQ(loaded(path, channel("blue")), "cficfi");
    EXPECT_EQ(loaded(path, channel("index")), indices);
    EXPECT_EQ(open_volume(path)->info().volumes.channels.size(), 5U);
    PngRecipe greys = colours;
    greys.chunks = chunk("PLTE", "xxxaaazzz");
    EXPECT_EQ(loaded(folder.write("v", png(greys, indices))), "xazxaz");
    greys.chunks = chunk("PLTE", "xxxaaa");
    expect_helpful(failure_of_loading(folder.write("v", png(greys, indices))), ErrorKind::input, "");
    const std::string table = std::string("cba\0feq\0", 8);
    path = folder.write("v", bmp(3, 2, std::string("\x00\x01\x00\x00\x01\x01\x00\x00", 8), table, 8));
    EXPECT_EQ(loaded(path, channel("index")), std::string("\x01\x01\x00\x00\x01\x00", 6));
    EXPECT_EQ(loaded(path, channel("red")), "qqaaqa");
    expect_helpful(failure_of_loading(folder.write("v", bmp(3, 2, std::string("\x00\x01\x02\x00\x01\x01\x00\x00", 8), table, 8))),
                   ErrorKind::input, "no colour");
}

TEST(Picture, SpacingInRealUnits) {
    const TestFolder folder;
    const auto geometry = [&](const std::string& file) { return open_volume(folder.write("v", file))->info().geometry; };
    const std::string pixels = telling_bytes(20), density = big_word(10000) + big_word(5000);
    EXPECT_EQ(geometry(png({.chunks = chunk("pHYs", density + '\1')}, pixels)), (Geometry{.spacing = {0.1, 0.2, 0.1}, .unit = "mm"}));
    EXPECT_EQ(geometry(png({.chunks = chunk("pHYs", density + '\0')}, pixels)), Geometry{});
    EXPECT_EQ(geometry(bmp(1, 1, "abcd")), (Geometry{.spacing = {0.1, 0.2, 0.1}, .unit = "mm"}));
}

TEST(Picture, FolderOfSlices) {
    const TestFolder folder;
    std::string expected;
    for (const int i : {1, 2, 10}) {
        const std::string samples = telling_bytes(20 * 11).substr(static_cast<std::size_t>(20 * i), 20);
        expected += samples;
        folder.write("s" + std::to_string(i) + ".png", png({}, samples));
    }
    const std::string path = folder / ".";
    const auto reader = open_volume(path);
    EXPECT_EQ(reader->info().extent, (Extent{.rank = 3, .size = {5, 4, 3}}));
    EXPECT_EQ(read_all(*reader, 3), expected);
    expect_slabs_equal_whole(path);
    folder.write("s2.png", png({.width = 4, .row_bytes = 4}, telling_bytes(16)));
    expect_helpful(failure_of([&] { static_cast<void>(read_all(*reader, 3)); }), ErrorKind::input, "changed");
    expect_helpful(failure_of_loading(path), ErrorKind::input, "s2.png");
    folder.write("s2.png", bmp(1, 1, "abcd"));
    expect_helpful(failure_of_loading(path), ErrorKind::input, "s2.png");
    folder.write("s2.png", "no picture");
    expect_helpful(failure_of_loading(path), ErrorKind::input, "s2.png");
    const TestFolder elsewhere;
    std::filesystem::remove(folder / "s2.png");
    std::filesystem::create_symlink(elsewhere.write("s2.png", png({}, telling_bytes(20))), folder / "s2.png");
    expect_helpful(failure_of_loading(path), ErrorKind::input, "link");
    std::filesystem::create_symlink(elsewhere / "s2.png", folder / "s3");
    OpenOptions follow;
    follow.follow_links = true;
    EXPECT_EQ(open_volume(path, follow)->info().extent.size[2], 4);
    std::filesystem::remove(folder / "s2.png");
    EXPECT_EQ(open_volume(path)->info().extent.size[2], 2);
}

TEST(Picture, ClaimsBeyondTheFile) {
    const TestFolder folder;
    const std::string pixels = telling_bytes(20);
    for (const std::uint32_t size : {100000U, 0x7fffffffU}) {
        expect_helpful(failure_of_loading(folder.write("v", png({.width = size, .height = size}, pixels))), ErrorKind::input, "claims");
        expect_helpful(failure_of_loading(folder.write("v", bmp(static_cast<std::int32_t>(size), 70000, pixels))), ErrorKind::input,
                       "ends");
    }
    expect_helpful(failure_of_loading(folder.write("v", png({.height = 5}, pixels))), ErrorKind::input, "PNG data");
    expect_helpful(failure_of_loading(folder.write("v", png({.height = 3}, pixels))), ErrorKind::input, "PNG data");
    std::string forged = jpeg();
    forged.replace(forged.find("\xff\xc0") + 5, 4, "\xf0\xf0\xf0\xf0");
    expect_helpful(failure_of_loading(folder.write("v", forged)), ErrorKind::input, "claims");
    EXPECT_EQ(loaded(folder.write("v", jpeg())).size(), 128U);
}

TEST(Picture, WhatIsNotRead) {
    const TestFolder folder;
    expect_helpful(failure_of_loading(folder.write("v", bmp(1, 1, "abcd", "", 16))), ErrorKind::unsupported, "16 bits");
    std::string coded = jpeg();
    coded[coded.find("\xff\xc0") + 1] = '\xc9';
    expect_helpful(failure_of_loading(folder.write("v", coded)), ErrorKind::unsupported, "");
    coded[coded.find("\xff\xc9") + 1] = '\xc3';
    expect_helpful(failure_of_loading(folder.write("v", coded)), ErrorKind::unsupported, "");
}

TEST(Picture, DamagedFiles) {
    constexpr std::int64_t kRatio = 8 * 1032;
    const std::string of_png = png(
        {.colour = 3, .chunks = chunk("PLTE", telling_bytes(60)) + chunk("pHYs", big_word(9) + big_word(8) + '\1')}, std::string(20, '\2'));
    const std::string of_bmp = bmp(3, 2, std::string(24, 'x')), of_table = bmp(3, 2, std::string(8, '\0'), "abcdefgh", 8);
    expect_truncations_refused("v.png", of_png);
    expect_truncations_refused("v.jpg", jpeg());
    expect_truncations_refused("v.bmp", of_bmp);
    expect_bit_flips_harmless("v.png", of_png, 0, of_png.size(), kRatio);
    expect_bit_flips_harmless("v.jpg", jpeg(), 0, jpeg().size(), kRatio);
    expect_bit_flips_harmless("v.bmp", of_bmp, 0, of_bmp.size(), kRatio);
    expect_bit_flips_harmless("v.bmp", of_table, 0, of_table.size(), kRatio);
}

}  // namespace
}  // namespace isoatlas
