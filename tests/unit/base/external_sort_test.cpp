// What is sorted in pieces comes in the same order as what is sorted at once: few values, all alike, and many.
#include "base/external_sort.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "base/big_vector.h"
#include "base/parallel_sort.h"

namespace isoatlas {
namespace {

struct Item {
    double key;
    std::uint64_t place;
    friend bool operator==(const Item&, const Item&) = default;
};

double key(const Item& item) { return item.key; }
bool before(const Item& p, const Item& q) { return p.key != q.key ? p.key < q.key : p.place < q.place; }

class ExternalSort : public testing::TestWithParam<int> {
protected:
    static constexpr std::size_t kItems = 1 << 18;

    [[nodiscard]] static std::vector<Item> items() {
        std::mt19937_64 random(7);
        std::vector<Item> result;
        for (std::size_t i = 0; i < kItems; ++i) result.push_back({static_cast<double>(random() % GetParam()), i});
        std::shuffle(result.begin(), result.end(), random);
        return result;
    }
    [[nodiscard]] static std::vector<Item> sorted() {
        std::vector<Item> result = items();
        std::sort(result.begin(), result.end(), before);
        return result;
    }
};

TEST_P(ExternalSort, ChunksInAnyMemory) {
    for (const std::int64_t limit : {std::int64_t{0}, kMinMemory}) {
        std::optional<MemoryLimit> holds;
        if (limit > 0) holds.emplace(limit, testing::TempDir());
        const std::vector<Item> all = items();
        std::vector<BigVector<Item>> chunks;
        for (std::size_t first = 0; first < all.size(); first += 100000)
            chunks.emplace_back(all.begin() + first, all.begin() + std::min(first + 100000, all.size()));
        BigVector<Item> result;
        sort_chunks(
            2, std::move(chunks), key, before, [&](std::size_t n) { result.resize(n); },
            [&](std::size_t first, std::span<const Item> some) {
                if (limit > 0) {
                    ASSERT_LE(some.size(), sortable_items<Item>(2));  // no more than that is ever in memory at once
                }
                write_part<Item>(std::span(result).subspan(first, some.size()), some);
            });
        EXPECT_TRUE(std::ranges::equal(result, sorted())) << limit;
    }
}

TEST_P(ExternalSort, RunsOfAnyLength) {
    const MemoryLimit limit(kMinMemory, testing::TempDir());
    for (const std::size_t length : {std::size_t{1000}, std::size_t{65537}, kItems}) {
        const std::vector<Item> all = items();
        BigVector<Item> array(all.begin(), all.end());
        ASSERT_TRUE(is_scratch(array.data()));
        std::vector<Item> result;
        sort_large(2, std::span(array), length, key, before, [&](std::size_t place, std::span<const Item> some) {
            ASSERT_EQ(place, result.size());
            result.insert(result.end(), some.begin(), some.end());
        });
        EXPECT_EQ(result, sorted()) << length;
    }
}

INSTANTIATE_TEST_SUITE_P(DifferentKeys, ExternalSort, testing::Values(1, 3, 1 << 20));

}  // namespace
}  // namespace isoatlas
