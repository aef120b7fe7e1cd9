// Pieces of files in memory, beside a plain map of bytes.
#include <gtest/gtest.h>

#include <random>

#include "remote/piece_cache.h"

namespace isoatlas {
namespace {

/// The byte of a file at an offset: pieces of different files and places differ.
std::byte byte_at(std::int64_t file, std::int64_t offset) { return static_cast<std::byte>((file * 131 + offset * 7 + offset / 251) & 255); }

std::vector<std::byte> bytes_of(std::int64_t file, const FileRange& range) {
    std::vector<std::byte> bytes;
    for (std::int64_t at = range.begin; at < range.end; ++at) bytes.push_back(byte_at(file, at));
    return bytes;
}

TEST(PieceCache, WhatIsReadWasAddedAndTheRestIsMissing) {
    constexpr std::int64_t kSize = 2000;
    std::mt19937_64 random(3);
    const auto below = [&](std::int64_t n) { return static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(n)); };
    PieceCache cache(std::int64_t{1} << 30);
    std::vector<std::vector<bool>> there(2, std::vector<bool>(kSize, false));
    for (int step = 0; step < 300; ++step) {
        const std::int64_t file = below(2), begin = below(kSize), end = begin + 1 + below(std::min<std::int64_t>(kSize - begin, 60));
        cache.add(file, begin, bytes_of(file, {begin, end}));
        for (std::int64_t at = begin; at < end; ++at) there[static_cast<std::size_t>(file)][static_cast<std::size_t>(at)] = true;
        const std::int64_t asked = below(2), from = below(kSize), to = from + 1 + below(kSize - from);
        const std::vector<bool>& present = there[static_cast<std::size_t>(asked)];
        std::vector<std::byte> out(static_cast<std::size_t>(to - from));
        const std::size_t got = cache.read(asked, from, out);
        std::size_t expected = 0;
        while (expected < out.size() && present[static_cast<std::size_t>(from) + expected]) ++expected;
        ASSERT_EQ(got, expected);
        for (std::size_t i = 0; i < got; ++i) ASSERT_EQ(out[i], byte_at(asked, from + static_cast<std::int64_t>(i)));
        std::vector<bool> missing(kSize, false);
        for (const FileRange& gap : cache.missing(asked, {from, to})) {
            for (std::int64_t at = gap.begin; at < gap.end; ++at) missing[static_cast<std::size_t>(at)] = true;
        }
        for (std::int64_t at = from; at < to; ++at)
            ASSERT_EQ(missing[static_cast<std::size_t>(at)], !present[static_cast<std::size_t>(at)]);
    }
    cache.forget(0);
    EXPECT_EQ(cache.missing(0, {0, kSize}), (std::vector<FileRange>{{0, kSize}}));
}

TEST(PieceCache, KeepsItsBudgetAndWhatWasUsedLast) {
    PieceCache cache(1000);
    for (std::int64_t i = 0; i < 10; ++i) cache.add(1, 100 * i, bytes_of(1, {100 * i, 100 * i + 100}));
    std::vector<std::byte> out(100);
    ASSERT_EQ(cache.read(1, 0, out), 100U);
    cache.add(2, 0, bytes_of(2, {0, 300}));
    EXPECT_LE(cache.bytes(), 1000);
    EXPECT_EQ(cache.read(1, 0, out), 100U);
    EXPECT_EQ(cache.read(1, 100, out), 0U);
}

}  // namespace
}  // namespace isoatlas
