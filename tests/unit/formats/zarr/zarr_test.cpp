// Zarr arrays of every layout, in folders and zip archives; damage; refusals. tests/python/test_zarr.py has those of zarr-python.
#include <gtest/gtest.h>

#include <filesystem>
#include <random>

#include "base/memory_limit.h"
#include "formats/zarr/codecs.h"
#include "unit/formats/zarr/zarr_files.h"

namespace isoatlas {
namespace {

using test::expect_helpful;
using test::failure_of_loading;
using test::Keys;
using test::Layout;
using test::Sizes;

std::string text_of(const Layout& layout) {
    return "version " + std::to_string(layout.version) + " " + layout.type + (layout.big ? " big" : " little") + " shape " +
           test::list_text(layout.shape) + " chunks " + test::list_text(layout.chunk) + " shards " + test::list_text(layout.shard) +
           " order " + test::list_text(layout.order) + " " + layout.separator + (layout.begins_with_c ? "c " : " ") + layout.compressor +
           (layout.leaves_chunks_out ? " holes" : "");
}

/// The array is read in whole, in slabs of any size, and in boxes, as sample_at() has it.
void expect_read(const std::string& path, const Layout& layout, const Sizes& fixed, const OpenOptions& options = {}) {
    SCOPED_TRACE(text_of(layout));
    const std::string expected = test::expected_samples(layout, fixed);
    const auto reader = open_volume(path, options);
    const VolumeInfo& info = reader->info();
    EXPECT_TRUE(info.slab_readable);
    for (std::size_t a = 0; a < static_cast<std::size_t>(info.extent.rank); ++a)
        ASSERT_EQ(info.extent.size[a], layout.shape[layout.shape.size() - 1 - a]);
    for (std::int64_t slices = 1; slices <= info.extent.size[2]; ++slices) ASSERT_EQ(test::read_all(*reader, slices), expected);
    const std::size_t sample = size_of(info.type);
    SampleBox box{{0, 0, 0}, info.extent.size};
    for (std::size_t a = 0; a < 3; ++a) box.begin[a] = info.extent.size[a] / 2;
    std::string part(static_cast<std::size_t>(box.size().product()) * sample, '?'), expected_part;
    reader->read_box(box, std::as_writable_bytes(std::span(part)));
    for (std::int64_t z = box.begin[2]; z < box.end[2]; ++z) {
        for (std::int64_t y = box.begin[1]; y < box.end[1]; ++y)
            expected_part += expected.substr(static_cast<std::size_t>(info.extent.index(box.begin[0], y, z)) * sample,
                                             static_cast<std::size_t>(box.size()[0]) * sample);
    }
    EXPECT_EQ(part, expected_part);
}

TEST(Zarr, EveryTypeAndByteOrder) {
    const test::TestFolder folder;
    int number = 0;
    for (const int version : {2, 3}) {
        for (const char* type : {"u1", "i1", "u2", "i2", "u4", "i4", "f4", "f8", "b1"}) {
            for (const bool big : {false, true}) {
                Layout layout{.version = version, .type = type, .big = big, .leaves_chunks_out = true};
                const std::string path = test::folder_of(folder, std::to_string(number++), test::array_keys(layout));
                expect_read(path, layout, {});
                EXPECT_EQ(open_volume(path)->info().format, "Zarr");
            }
        }
    }
}

TEST(Zarr, RandomLayouts) {
    const test::TestFolder folder;
    std::mt19937 random(1);
    const auto below = [&](std::int64_t n) { return static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(n)); };
    const char* const kTypes[] = {"u1", "i2", "u4", "f4", "f8"};
    const char* const kCompressors[] = {"", "zlib", "gzip"};
    for (int i = 0; i < 200; ++i) {
        Layout layout{.version = 2 + static_cast<int>(below(2)), .type = kTypes[below(5)], .big = below(2) == 1};
        const std::size_t rank = 2 + static_cast<std::size_t>(below(3));
        layout.shape.clear(), layout.chunk.clear();
        for (std::size_t axis = 0; axis < rank; ++axis) layout.shape.push_back(1 + below(7)), layout.chunk.push_back(1 + below(9));
        layout.separator = below(2) == 1 ? '/' : '.';
        layout.begins_with_c = below(2) == 1;
        layout.compressor = kCompressors[below(3)];
        layout.leaves_chunks_out = below(2) == 1;
        if (below(2) == 1) {
            layout.order.resize(rank);
            std::iota(layout.order.begin(), layout.order.end(), std::size_t{0});
            std::reverse(layout.order.begin(), layout.order.end());
            if (layout.version == 3) std::shuffle(layout.order.begin(), layout.order.end(), random);
        }
        if (layout.version == 3 && below(2) == 1) {
            for (const std::int64_t size : layout.chunk) layout.shard.push_back(size * (1 + below(3)));
            layout.index_at_start = below(2) == 1;
            layout.index_has_checksum = below(2) == 1;
        }
        const Keys keys = test::array_keys(layout);
        const std::string name = std::to_string(i);
        const std::string path = below(2) == 1 ? test::folder_of(folder, name, keys)
                                               : folder.write(name + ".zip", test::zip_of(keys, below(2) == 1, "a comment"));
        OpenOptions options;
        Sizes fixed;
        if (rank == 4) fixed = {below(layout.shape[0])}, options.time_step = fixed[0];
        expect_read(path, layout, fixed, options);
        if (testing::Test::HasFailure()) return;
    }
}

TEST(Zarr, ChecksumOfTheStandard) {
    const std::string text = "123456789";
    EXPECT_EQ(crc32c(std::as_bytes(std::span(text))), 0xe3069283U);
}

TEST(Zarr, HalvesAndFillValues) {
    const test::TestFolder folder;
    const auto with_fill = [&](const std::string& type, const std::string& fill) {
        const std::string metadata =
            R"({"zarr_format":3,"node_type":"array","shape":[2,2],"data_type":")" + type +
            R"(","chunk_grid":{"name":"regular","configuration":{"chunk_shape":[2,2]}},"chunk_key_encoding":{"name":"default"},)" +
            R"("fill_value":)" + fill + R"(,"codecs":["bytes"]})";
        return test::folder_of(folder, "fill", {{"zarr.json", metadata}});
    };
    const auto value = [&](const std::string& type, const std::string& fill) {
        const auto reader = open_volume(with_fill(type, fill));
        Volume volume = make_volume(reader->info().extent, reader->info().type);
        reader->read(0, 1, std::as_writable_bytes(std::span(volume.bytes.data(), volume.bytes.size())));
        return volume.value(3);
    };
    EXPECT_EQ(value("uint8", "255"), 255);
    EXPECT_EQ(value("int32", "-5"), -5);
    EXPECT_EQ(value("int16", "3.0"), 3);
    EXPECT_EQ(value("float32", "0.5"), 0.5);
    EXPECT_EQ(value("float64", "\"0x3ff8000000000000\""), 1.5);
    EXPECT_EQ(value("float32", "\"0xbf800000\""), -1);
    EXPECT_EQ(value("float16", "\"0x3c00\""), 1);
    EXPECT_EQ(value("float16", "0.1"), 0.0999755859375);
    EXPECT_EQ(value("float16", "1e-7"), 0x1p-23);
    EXPECT_EQ(value("float32", "\"-Infinity\""), -std::numeric_limits<double>::infinity());
    EXPECT_TRUE(std::isnan(value("float64", "\"NaN\"")));
    for (const auto& [type, fill] : {std::pair{"uint8", "256"},
                                     {"uint8", "-1"},
                                     {"int8", "1.5"},
                                     {"uint8", "\"NaN\""},
                                     {"float32", "1e39"},
                                     {"float32", "\"0x123456789\""},
                                     {"float32", "\"x\""},
                                     {"float32", "[]"},
                                     {"int32", "1e10"}})
        expect_helpful(failure_of_loading(with_fill(type, fill)), ErrorKind::input, "fill_value");
}

Keys with(Keys keys, const std::string& key, const std::string& from, const std::string& to) {
    std::string& text = keys.at(key);
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from << " not in " << text;
    text.replace(at, from.size(), to);
    return keys;
}

TEST(Zarr, Refusals) {
    const test::TestFolder folder;
    const Keys two = test::array_keys({}), three = test::array_keys({.version = 3, .compressor = "gzip"}),
               shards = test::array_keys({.version = 3, .shard = {4, 6, 8}});
    int number = 0;
    const auto refused = [&](const Keys& keys, ErrorKind kind, const std::string& says) {
        expect_helpful(failure_of_loading(test::folder_of(folder, std::to_string(number++), keys)), kind, says);
    };
    refused(with(two, ".zarray", R"("compressor":null)", R"("compressor":{"id":"lzma"})"), ErrorKind::unsupported, "lzma");
    refused(with(two, ".zarray", R"("filters":null)", R"("filters":[{"id":"quantize"}])"), ErrorKind::unsupported, "quantize");
    refused(with(two, ".zarray", "<u2", "<c8"), ErrorKind::unsupported, "c8");
    refused(with(two, ".zarray", "<u2", "<M8[s]"), ErrorKind::unsupported, "M8[s]");
    refused(with(two, ".zarray", "\"<u2\"", R"([["a","<u2"]])"), ErrorKind::unsupported, "several values");
    refused(with(two, ".zarray", "<u2", "|u2"), ErrorKind::input, "byte order");
    refused(with(two, ".zarray", "[4,5,6]", "[4,5,0]"), ErrorKind::input, "shape");
    refused(with(two, ".zarray", "[4,5,6]", "[4,5]"), ErrorKind::input, "numbers of axes");
    refused(with(two, ".zarray", "[4,5,6]", "[4,5,-6]"), ErrorKind::input, "shape");
    refused(with(two, ".zarray", "[4,5,6]", "[4,5,99999999999999999999]"), ErrorKind::input, "shape");
    refused(with(two, ".zarray", "[2,3,4]", "[2,3,0]"), ErrorKind::input, "chunks");
    refused(with(two, ".zarray", "[2,3,4]", "[9000000000,9000000000,9000000000]"), ErrorKind::input, "2^50");
    refused(with(two, ".zarray", "[4,5,6]", "[9000000000,9000000000,9000000000]"), ErrorKind::input, "63 bits");
    refused(with(two, ".zarray", "\"C\"", "\"A\""), ErrorKind::input, "order");
    refused(with(two, ".zarray", "{", ""), ErrorKind::input, "JSON");
    refused(with(two, ".zarray", R"("filters":null)", R"("x":)" + std::string(100000, '[') + std::string(100000, ']')), ErrorKind::input,
            "nested");
    refused(with(three, "zarr.json", "gzip", "pcodec"), ErrorKind::unsupported, "pcodec");
    refused(with(three, "zarr.json", R"({"name":"bytes")", R"({"name":"crc32c"},{"name":"bytes")"), ErrorKind::input, "bytes");
    refused(with(three, "zarr.json", "regular", "rectangular"), ErrorKind::unsupported, "rectangular");
    refused(with(three, "zarr.json", "uint16", "complex64"), ErrorKind::unsupported, "complex64");
    refused(with(three, "zarr.json", "uint16", "int128"), ErrorKind::unsupported, "int128");
    refused(with(three, "zarr.json", R"("attributes")", R"("future":{"must_understand":true},"attributes")"), ErrorKind::unsupported,
            "future");
    refused(with(three, "zarr.json", "\"array\"", "\"tree\""), ErrorKind::input, "node_type");
    refused(with(shards, "zarr.json", "[2,3,4]", "[2,3,5]"), ErrorKind::input, "whole chunks");
    refused(with(shards, "zarr.json", "[2,3,4]", "[2,3]"), ErrorKind::input, "numbers of axes");
    refused(test::array_keys({.shape = {2, 2, 2, 2, 2}, .chunk = {2, 2, 2, 2, 2}}), ErrorKind::unsupported, "5 axes");
    refused(test::array_keys({.shape = {9}, .chunk = {2}}), ErrorKind::unsupported, "1 axes");
}

TEST(Zarr, DamagedChunks) {
    const test::TestFolder folder;
    int number = 0;
    const auto refused = [&](Keys keys, const std::string& key, const std::string& value, const std::string& says) {
        keys.at(key) = value;
        expect_helpful(failure_of_loading(test::folder_of(folder, std::to_string(number++), keys)), ErrorKind::input, says);
    };
    const Keys raw = test::array_keys({}), packed = test::array_keys({.compressor = "zlib"}),
               shards = test::array_keys({.version = 3, .shard = {4, 6, 8}, .compressor = "gzip"});
    refused(raw, "0.0.0", raw.at("0.0.0").substr(1), "47 bytes instead of 48");
    refused(raw, "0.0.0", raw.at("0.0.0") + "x", "49 bytes");
    refused(raw, "1.1.1", "", "0 bytes");
    const std::string whole = packed.at("0.0.0");
    for (std::size_t size = 0; size < whole.size(); ++size) refused(packed, "0.0.0", whole.substr(0, size), "damaged");
    refused(packed, "0.0.0", test::zlib(std::string(1000000, 'x')), "more than 48 bytes");
    refused(packed, "0.0.0", test::zlib("x"), "1 bytes instead of 48");
    refused(packed, "0.0.0", whole + "rest", "damaged");
    refused(packed, "0.0.0", std::string(100000, 'x'), "at most");
    const std::string shard = shards.at("c.0.0.0");
    for (std::size_t size = 0; size < shard.size(); size += 7) refused(shards, "c.0.0.0", shard.substr(0, size), "");
    for (std::size_t byte = 0; byte < shard.size(); ++byte) {
        std::string damaged = shard;
        damaged[byte] = static_cast<char>(damaged[byte] ^ 0x10);
        Keys keys = shards;
        keys.at("c.0.0.0") = damaged;
        const test::Failure failure = failure_of_loading(test::folder_of(folder, "flip", keys));
        if (!failure.message.empty()) test::expect_user_error(failure, "byte " + std::to_string(byte));
    }
}

TEST(Zarr, ManySamplesThatAreNotThere) {
    const test::TestFolder folder;
    Keys keys{{".zarray",
               R"({"zarr_format":2,"shape":[100000,100000,100000],"chunks":[100000,100000,1000],"dtype":"<f4","order":"C","filters":null,)"
               R"("fill_value":7,"compressor":{"id":"zlib"}})"}};
    const auto reader = open_volume(test::folder_of(folder, "v", keys));
    EXPECT_EQ(reader->info().extent.size, (Index3{100000, 100000, 100000}));
    std::vector<float> samples(8);
    reader->read_box({{5000, 5000, 5000}, {5002, 5002, 5002}}, std::as_writable_bytes(std::span(samples)));
    EXPECT_EQ(samples, std::vector<float>(8, 7));
    keys["0.0.0"] = test::zlib("a few bytes");  // cannot stand for 40 TB
    const auto damaged = open_volume(test::folder_of(folder, "v", keys));
    const test::Failure failure =
        test::failure_of([&] { damaged->read_box({{0, 0, 0}, {1, 1, 1}}, std::as_writable_bytes(std::span(samples).first(1))); });
    expect_helpful(failure, ErrorKind::input, "11 bytes instead of");
    EXPECT_NE(failure_of_loading(folder / "v").message, "");
}

TEST(Zarr, LinksAndPathsThatLeadOut) {
    const test::TestFolder folder;
    const Keys keys = test::array_keys({});
    folder.write("secret", keys.at("0.0.0"));
    Keys others = keys;
    others.erase("0.0.0");
    const std::string path = test::folder_of(folder, "v", others);
    std::filesystem::create_symlink("../secret", std::filesystem::path(path) / "0.0.0");
    test::expect_reason(failure_of_loading(path), ErrorKind::input, Reason::file_outside_folder);
    OpenOptions trusting;
    trusting.follow_links = true;
    EXPECT_EQ(test::text_of_bytes(load_volume(path, trusting)), test::expected_samples({}, {}));
    std::filesystem::remove(std::filesystem::path(path) / "0.0.0");
    std::filesystem::create_symlink("0.0.1", std::filesystem::path(path) / "0.0.0");  // inside
    EXPECT_EQ(failure_of_loading(path).message, "");
    const std::string image = R"({"multiscales":[{"axes":["z","y","x"],"datasets":[{"path":"../v"}]}]})";
    expect_helpful(failure_of_loading(test::folder_of(folder, "image", {{".zgroup", R"({"zarr_format":2})"}, {".zattrs", image}})),
                   ErrorKind::input, "leads out");
    OpenOptions out;
    out.dataset = "/../v";
    expect_helpful(failure_of_loading(test::folder_of(folder, "group", {{".zgroup", "{}"}, {"a/.zarray", keys.at(".zarray")}}), out),
                   ErrorKind::usage, "a");
}

TEST(Zarr, DamagedArchives) {
    const test::TestFolder folder;
    const std::string archive = test::zip_of(test::array_keys({.shape = {2, 2, 3}, .chunk = {2, 2, 2}}), true);
    for (std::size_t size = 0; size < archive.size(); ++size)
        test::expect_user_error(failure_of_loading(folder.write("v.zip", archive.substr(0, size))), "cut at " + std::to_string(size));
    for (std::size_t byte = 0; byte < archive.size(); ++byte) {
        for (const int bit : {0, 3, 7}) {
            std::string damaged = archive;
            damaged[byte] = static_cast<char>(damaged[byte] ^ 1 << bit);
            const test::Failure failure = failure_of_loading(folder.write("v.zip", damaged));
            if (!failure.message.empty()) test::expect_user_error(failure, "byte " + std::to_string(byte));
        }
    }
    test::expect_reason(failure_of_loading(folder.write("other.zip", test::zip_of({{"readme", "x"}}))), ErrorKind::unsupported,
                        Reason::foreign_format);
    Keys nested;
    for (const auto& [key, value] : test::array_keys({})) nested["image.zarr/" + key] = value;
    EXPECT_EQ(test::text_of_bytes(load_volume(folder.write("nested.zip", test::zip_of(nested)))), test::expected_samples({}, {}));
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // which take memory of their own
TEST(Zarr, SlabsTakeLittleMemory) {
    constexpr std::int64_t kSize = 512, kChunk = 64, kMost = std::int64_t{256} << 20;
    const test::TestFolder folder;
    std::vector<float> chunk(kChunk * kChunk * kChunk);
    for (std::size_t i = 0; i < chunk.size(); ++i) chunk[i] = static_cast<float>(i % 1000);
    const std::vector<std::byte> packed = encode_blosc(std::as_bytes(std::span(chunk)), sizeof(float));
    const std::string value(reinterpret_cast<const char*>(packed.data()), packed.size());
    Keys keys{{".zarray", R"({"zarr_format":2,"shape":[512,512,512],"chunks":[64,64,64],"dtype":"<f4","order":"C","filters":null,)"
                          R"("fill_value":0,"compressor":{"id":"blosc"}})"}};
    test::for_each_index({kSize / kChunk, kSize / kChunk, kSize / kChunk}, [&](const Sizes& at) {
        keys[std::to_string(at[0]) + "." + std::to_string(at[1]) + "." + std::to_string(at[2])] = value;
    });
    const auto reader = open_volume(test::folder_of(folder, "v", keys));
    keys.clear();
    std::vector<float> slice(kSize * kSize);
    const std::int64_t before = peak_memory();
    for (std::int64_t z = 0; z < kSize; ++z) {
        reader->read_box({{0, 0, z}, {kSize, kSize, z + 1}}, std::as_writable_bytes(std::span(slice)));
        ASSERT_EQ(slice[kSize * 65 + 66], chunk[static_cast<std::size_t>((z % kChunk) * kChunk * kChunk + kChunk + 2)]);
    }
    EXPECT_LE(peak_memory() - before, kMost);
}
#endif

}  // namespace
}  // namespace isoatlas
