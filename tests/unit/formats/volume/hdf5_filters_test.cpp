// Filters of HDF5: what HDF5 itself has encoded is decoded, and no damage takes memory or a byte too many.
#include "formats/volume/hdf5_filters.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "formats/common/hdf5_handle.h"
#include "unit/formats/volume/hdf5_files.h"
#include "unit/formats/volume/volume_files.h"

namespace isoatlas {
namespace {

using namespace test;
using Bytes = std::vector<std::byte>;

struct Encoded {
    std::vector<Hdf5ChunkFilter> filters;
    Bytes chunk;
    std::uint32_t skipped = 0;
};

std::vector<Hdf5ChunkFilter> filters_of(hid_t set) {
    const Hdf5Handle creation(H5Dget_create_plist(set), H5Pclose);
    std::vector<Hdf5ChunkFilter> filters;
    for (int i = 0; i < H5Pget_nfilters(creation); ++i) {
        unsigned flags = 0, config = 0;
        std::size_t count = 32;
        Hdf5ChunkFilter filter{.settings = std::vector<std::uint32_t>(count)};
        filter.id = H5Pget_filter2(creation, static_cast<unsigned>(i), &flags, &count, filter.settings.data(), 0, nullptr, &config);
        filter.settings.resize(count);
        filters.push_back(std::move(filter));
    }
    return filters;
}

/// The only chunk of an array, as HDF5 encodes it.
template <class T>
Encoded encode(const std::vector<T>& samples, hid_t type, const Hdf5Storage& given) {
    const TestFolder folder;
    const std::scoped_lock lock(hdf5_mutex());
    const Hdf5Maker maker(folder / "v.h5");
    Hdf5Storage storage = given;
    storage.chunk = {samples.size()};
    const hid_t set = maker.array("v", {samples.size()}, type, type, samples.data(), storage);
    H5Fflush(maker.file, H5F_SCOPE_LOCAL);
    Encoded encoded{.filters = filters_of(set), .chunk = {}};
    const hsize_t first = 0;
    hsize_t size = 0;
    Hdf5Maker::made(H5Dget_chunk_storage_size(set, &first, &size));
    encoded.chunk.resize(size);
    Hdf5Maker::made(H5Dread_chunk(set, H5P_DEFAULT, &first, &encoded.skipped, encoded.chunk.data()));
    return encoded;
}

std::string undo(const Encoded& encoded, std::size_t bytes, Bytes& value) {
    value = encoded.chunk;
    Bytes scratch;
    return undo_hdf5_filters(encoded.filters, encoded.skipped, bytes, value, scratch);
}

std::vector<std::uint32_t> numbers(std::size_t count) {
    std::mt19937 random(7);
    std::vector<std::uint32_t> samples(count);
    for (std::size_t i = 0; i < count; ++i) samples[i] = static_cast<std::uint32_t>(i / 3) + (random() & 7U);
    return samples;
}

const std::vector<Hdf5Storage> kStorages = {{.gzip = 4},
                                            {.shuffle = true},
                                            {.fletcher = true},
                                            {.gzip = 9, .shuffle = true},
                                            {.gzip = 1, .shuffle = true, .fletcher = true},
                                            {.shuffle = true, .fletcher = true}};

TEST(Hdf5Filters, WhatHdf5EncodesIsDecoded) {
    for (const std::size_t count : {1U, 2U, 3U, 361U, 1000U}) {
        const std::vector<std::uint32_t> samples = numbers(count);
        for (const Hdf5Storage& storage : kStorages) {
            const Encoded encoded = encode(samples, H5T_NATIVE_UINT32, storage);
            for (const Hdf5ChunkFilter& filter : encoded.filters) EXPECT_TRUE(is_known_hdf5_filter(filter)) << filter.id;
            Bytes value;
            ASSERT_EQ(undo(encoded, 4 * count, value), "");
            EXPECT_EQ(std::memcmp(value.data(), samples.data(), 4 * count), 0);
        }
    }
}

TEST(Hdf5Filters, ElementsOfAnySizeAreShuffled) {
    for (const std::uint32_t element : {1U, 2U, 3U, 4U, 5U, 8U, 16U}) {
        constexpr std::size_t kBytes = 83;  // with some behind the last whole element
        Bytes plain(kBytes), value;
        for (std::size_t i = 0; i < kBytes; ++i) plain[i] = static_cast<std::byte>(i);
        const std::size_t count = kBytes / element;
        value = plain;
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t byte = 0; byte < element; ++byte) value[byte * count + i] = plain[i * element + byte];
        }
        Bytes scratch;
        const std::vector<Hdf5ChunkFilter> shuffle = {{.id = 2, .settings = {element}}};
        ASSERT_EQ(undo_hdf5_filters(shuffle, 0, kBytes, value, scratch), "");
        EXPECT_EQ(value, plain) << element;
        value = plain;
        ASSERT_EQ(undo_hdf5_filters(shuffle, 1, kBytes, value, scratch), "") << "a filter that this chunk skipped";
        EXPECT_EQ(value, plain);
    }
}

TEST(Hdf5Filters, OtherFiltersAndWrongSizesAreTold) {
    Bytes value(8), scratch;
    for (const int id : {4, 5, 32008, 99999}) {  // szip, n-bit, bitshuffle, none
        EXPECT_FALSE(is_known_hdf5_filter({.id = id}));
        const std::vector<Hdf5ChunkFilter> filters = {{.id = id}};
        EXPECT_NE(undo_hdf5_filters(filters, 0, 8, value, scratch).find(std::to_string(id)), std::string::npos);
    }
    EXPECT_FALSE(is_known_hdf5_filter({.id = 6})) << "scale-offset without settings";
    EXPECT_EQ(undo_hdf5_filters({}, 0, 8, value, scratch), "");
    EXPECT_NE(undo_hdf5_filters({}, 0, 7, value, scratch), "");
    EXPECT_NE(undo_hdf5_filters({}, 0, 9, value, scratch), "");
    const std::vector<Hdf5ChunkFilter> no_element = {{.id = 2}};
    EXPECT_NE(undo_hdf5_filters(no_element, 0, 8, value, scratch), "");
}

TEST(Hdf5Filters, NoPrefixAndNoFlippedByteIsTakenForAChunk) {
    const std::vector<std::uint32_t> samples = numbers(200);
    for (const Hdf5Storage& storage : kStorages) {
        const Encoded whole = encode(samples, H5T_NATIVE_UINT32, storage);
        Bytes value;
        for (std::size_t size = 0; size < whole.chunk.size(); ++size) {
            Encoded cut = whole;
            cut.chunk.resize(size);
            EXPECT_NE(undo(cut, 800, value), "") << size;
        }
        for (std::size_t i = 0; i < whole.chunk.size(); ++i) {
            Encoded damaged = whole;
            damaged.chunk[i] ^= std::byte{0x41};
            const std::string error = undo(damaged, 800, value);
            if (storage.gzip >= 0 || storage.fletcher)
                EXPECT_NE(error, "") << i;  // both have checksums
            else
                EXPECT_EQ(value.size(), 800U);
        }
    }
}

TEST(Hdf5Filters, LzfByHand) {
    const std::vector<Hdf5ChunkFilter> lzf = {{.id = 32000}};
    Bytes scratch;
    const auto decoded = [&](std::initializer_list<int> from, std::size_t bytes) -> std::string {
        Bytes value;
        for (const int byte : from) value.push_back(static_cast<std::byte>(byte));
        if (const std::string error = undo_hdf5_filters(lzf, 0, bytes, value, scratch); !error.empty()) return "! " + error;
        std::string text;
        for (const std::byte byte : value) text += static_cast<char>(byte);
        return text;
    };
    EXPECT_EQ(decoded({2, 'a', 'b', 'c'}, 3), "abc");
    EXPECT_EQ(decoded({0, 'a', 0x20, 0}, 4), "aaaa");                                       // a copy that overlaps itself: 1 + 2 bytes
    EXPECT_EQ(decoded({1, 'a', 'b', 0xe0, 3, 1}, 14), "abababababab" + std::string("ab"));  // a long one: 7 + 3 + 2
    EXPECT_TRUE(decoded({0, 'a', 0x20, 1}, 4).starts_with("!")) << "before the beginning";
    EXPECT_TRUE(decoded({2, 'a', 'b'}, 3).starts_with("!")) << "literals are missing";
    EXPECT_TRUE(decoded({0, 'a', 0x20}, 4).starts_with("!"));
    EXPECT_TRUE(decoded({0, 'a', 0xe0, 3}, 13).starts_with("!"));
    EXPECT_TRUE(decoded({2, 'a', 'b', 'c'}, 2).starts_with("!")) << "too many";
    EXPECT_TRUE(decoded({2, 'a', 'b', 'c'}, 4).starts_with("!")) << "too few";
}

TEST(Hdf5Filters, Lz4HeadersThatLie) {
    const std::vector<Hdf5ChunkFilter> lz4 = {{.id = 32004}};
    const auto undone = [&](std::uint64_t size, std::uint32_t block, std::initializer_list<int> blocks, std::size_t bytes) {
        Bytes value, scratch;
        for (int bit = 56; bit >= 0; bit -= 8) value.push_back(static_cast<std::byte>(size >> bit));
        for (int bit = 24; bit >= 0; bit -= 8) value.push_back(static_cast<std::byte>(block >> bit));
        for (const int byte : blocks) value.push_back(static_cast<std::byte>(byte));
        return undo_hdf5_filters(lz4, 0, bytes, value, scratch);
    };
    EXPECT_EQ(undone(3, 3, {0, 0, 0, 3, 1, 2, 3}, 3), "") << "a block that is not compressed";
    EXPECT_EQ(undone(3, 2, {0, 0, 0, 2, 1, 2, 0, 0, 0, 1, 3}, 3), "");
    EXPECT_NE(undone(4, 3, {0, 0, 0, 3, 1, 2, 3}, 4), "");
    EXPECT_NE(undone(3, 0, {0, 0, 0, 3, 1, 2, 3}, 3), "");
    EXPECT_NE(undone(3, 3, {0, 0, 0, 4, 1, 2, 3}, 3), "");
    EXPECT_NE(undone(3, 3, {0, 0, 0}, 3), "");
    EXPECT_NE(undone(std::uint64_t{1} << 60, 3, {0, 0, 0, 3, 1, 2, 3}, 3), "");
    EXPECT_NE(undone(3, 0xffffffff, {255, 255, 255, 255}, 3), "");
}

}  // namespace
}  // namespace isoatlas
