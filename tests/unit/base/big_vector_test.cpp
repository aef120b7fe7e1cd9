// Large arrays that are gone leave their memory to those that come: also when none of them alone was large enough.
#include "base/big_vector.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <numeric>
#include <string>

namespace isoatlas {
namespace {

/// Bytes of this process that are in memory.
std::int64_t resident() {
    std::ifstream file("/proc/self/statm");
    std::int64_t size = 0, pages = 0;
    file >> size >> pages;
    return pages * 4096;
}

TEST(BigVector, PiecesThatAreFreeBecomeOne) {
    constexpr std::size_t kPart = std::size_t{5} << 20;  // numbers of 8 bytes
    trim_memory_pool();
    {
        std::vector<BigVector<std::int64_t>> parts;
        for (int i = 0; i < 4; ++i) parts.emplace_back(kPart, i);
        parts.erase(parts.begin() + 2);  // not beside each other
        parts.erase(parts.begin());
        for (const auto& part : parts)
            EXPECT_EQ(std::accumulate(part.begin(), part.end(), std::int64_t{0}) % static_cast<std::int64_t>(kPart), 0);
        const std::int64_t before = resident();
        BigVector<std::int64_t> whole(2 * kPart, 7);
        EXPECT_LT(resident() - before, std::int64_t{8} << 20) << "memory that was free was not used";
        EXPECT_EQ(std::accumulate(whole.begin(), whole.end(), std::int64_t{0}), 14 * static_cast<std::int64_t>(kPart));
        EXPECT_EQ(parts[0][0], 1);
        EXPECT_EQ(parts[1].back(), 3);
    }
    trim_memory_pool();
}

// The arrays of a small volume: none is as large as a huge page.
TEST(BigVector, SmallOnesUseTheMemoryOfALargeOne) {
    constexpr std::size_t kPart = std::size_t{1} << 16;
    trim_memory_pool();
    {
        const BigVector<std::int64_t> large(16 * kPart, 1);
    }
    const std::int64_t before = resident();
    std::vector<BigVector<std::int64_t>> parts;
    for (int i = 0; i < 16; ++i) parts.emplace_back(kPart, i);
    EXPECT_LT(resident() - before, std::int64_t{1} << 20) << "memory that was free was not used";
    for (int i = 0; i < 16; ++i) EXPECT_EQ(std::accumulate(parts[i].begin(), parts[i].end(), std::int64_t{0}), i * std::ssize(parts[i]));
    parts.clear();
    trim_memory_pool();
}

/// Pages that the system has given to this process.
long faults() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_minflt;
}

// Two arrays of the same sizes, a third that is another one each time, and a result whose size changes, as steps of a Navigator make them.
TEST(BigVector, AQueryThatIsAskedAgainTakesNoFreshMemory) {
    trim_memory_pool();
    BigVector<char> result;
    long before = 0;
    for (std::size_t round = 0; round < 400; ++round) {
        if (round == 100) before = faults();
        const BigVector<char> bits(900'000, 1), rows(1'900'000, 1);
        resize_for_overwrite(result, 100'000 + round * 7919 % 200'000);
        std::fill(result.begin(), result.end(), 1);
        const BigVector<char> again(900'000 + round % 3 * 70'000, 1);
        ASSERT_EQ(std::accumulate(again.begin(), again.end(), std::size_t{0}), again.size());
    }
    EXPECT_LT(faults() - before, 300) << "300 queries";
    release(result);
    trim_memory_pool();
}

// Many sizes in turn, every number checked: pages must not be in two places.
TEST(BigVector, HoldsWhatIsWritten) {
    std::vector<std::pair<BigVector<std::uint64_t>, std::uint64_t>> held;
    std::uint64_t state = 1;
    for (int round = 0; round < 60; ++round) {
        state = state * 6364136223846793005ULL + 1442695040888963407ULL;
        const std::size_t unit = std::size_t{1} << (round % 3 == 0 ? 18 : 14);  // those below huge pages are cut from the end of a piece
        const std::size_t size = unit * (1 + (state >> 33) % 12);
        if (held.size() > 5) held.erase(held.begin() + static_cast<std::ptrdiff_t>((state >> 40) % held.size()));
        held.emplace_back(BigVector<std::uint64_t>(size, state), state);
        for (const auto& [numbers, value] : held) {
            for (std::size_t i = 0; i < numbers.size(); i += 512) ASSERT_EQ(numbers[i], value);
        }
    }
    held.clear();
    trim_memory_pool();
}

}  // namespace
}  // namespace isoatlas
