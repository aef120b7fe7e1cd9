// Parts are read and written in turn, in memory and in the scratch file alike.
#include "base/part_streams.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>
#include <optional>
#include <random>

#include "base/big_vector.h"

namespace isoatlas {
namespace {

constexpr std::size_t kItems = 1 << 19;  // more than what stays in memory anyway

/// Parts of very different sizes, some of them empty.
std::vector<std::size_t> some_parts(std::mt19937& random) {
    std::vector<std::size_t> first{0, 0};
    while (first.back() < kItems) first.push_back(std::min(kItems, first.back() + (random() % 3 == 0 ? 0 : random() % 40000)));
    first.push_back(kItems);
    return first;
}

/// A part for every item, so that each part gets as many as it holds.
std::vector<std::uint32_t> turns_of(const std::vector<std::size_t>& first, std::mt19937& random) {
    std::vector<std::uint32_t> turns;
    for (std::uint32_t p = 0; p + 1 < first.size(); ++p) turns.insert(turns.end(), first[p + 1] - first[p], p);
    std::shuffle(turns.begin(), turns.end(), random);
    return turns;
}

class PartStreams : public testing::TestWithParam<bool> {
protected:
    void SetUp() override {
        if (GetParam()) limit_.emplace(kMinMemory, testing::TempDir());
    }
    std::optional<MemoryLimit> limit_;
};

TEST_P(PartStreams, EveryItemIsWhereItBelongs) {
    std::mt19937 random(1);
    const std::vector<std::size_t> first = some_parts(random);
    const std::vector<std::uint32_t> turns = turns_of(first, random);
    BigVector<std::uint64_t> items(kItems);
    EXPECT_EQ(is_scratch(items.data()), GetParam());
    EXPECT_EQ(is_scratch(items.data() + kItems - 1), GetParam());
    EXPECT_FALSE(is_scratch(&random));

    std::vector<std::size_t> next = first;
    PartWriters<std::uint64_t> writers(items, first);
    for (const std::uint32_t p : turns) writers.put(p, next[p]++);
    writers.finish();
    for (std::size_t i = 0; i < kItems; ++i) ASSERT_EQ(items[i], i);  // through the mapping

    for (std::size_t i = 0; i < kItems; ++i) items[i] = 3 * i;
    next = first;
    PartReaders<std::uint64_t> readers(items, first);
    for (const std::uint32_t p : turns) ASSERT_EQ(readers.next(p), 3 * next[p]++);

    std::vector<std::uint64_t> buffer;
    const auto part = part_in_memory<std::uint64_t>(std::span<const std::uint64_t>(items).subspan(100, 50), buffer);
    for (std::size_t i = 0; i < 50; ++i) EXPECT_EQ(part[i], 3 * (100 + i));
    write_part<std::uint64_t>(std::span(items).subspan(100, 50), std::vector<std::uint64_t>(50, 7));
    EXPECT_EQ(std::accumulate(items.begin() + 99, items.begin() + 151, std::uint64_t{0}), 50 * 7 + 3 * 99 + 3 * 150);
}

TEST_P(PartStreams, SomeArraysStayInMemory) {
    const PinInMemory keep;
    const BigVector<std::uint64_t> few(kItems);
    EXPECT_FALSE(is_scratch(few.data()));
    const BigVector<std::uint64_t> many(32 * kItems);
    EXPECT_EQ(is_scratch(many.data()), GetParam());
}

INSTANTIATE_TEST_SUITE_P(Memory, PartStreams, testing::Bool());

}  // namespace
}  // namespace isoatlas
