// Requests for lists of ranges: they cover what is wanted, waste little, and are few.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "remote/range_plan.h"

namespace isoatlas {
namespace {

std::vector<FileRange> random_ranges(std::mt19937_64& random, std::size_t count, std::int64_t longest_gap) {
    std::vector<FileRange> ranges;
    std::int64_t at = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const auto below = [&](std::int64_t n) { return static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(n)); };
        at += 1 + below(longest_gap);
        const std::int64_t bytes = 1 + below(i % 7 == 0 ? 5 * kLongestRequest / 2 : 20000);
        ranges.push_back({at, at + bytes});
        at += bytes;
    }
    return ranges;
}

std::int64_t total(const std::vector<FileRange>& ranges) {
    return std::accumulate(ranges.begin(), ranges.end(), std::int64_t{0},
                           [](std::int64_t sum, const FileRange& r) { return sum + r.bytes(); });
}

bool covers(const std::vector<FileRange>& requests, const FileRange& range) {
    std::int64_t position = range.begin;
    for (const FileRange& request : requests) {
        if (request.begin <= position && position < request.end) position = request.end;
    }
    return position >= range.end;
}

void expect_sound(const std::vector<FileRange>& requests, const std::vector<FileRange>& wanted) {
    for (std::size_t i = 0; i < requests.size(); ++i) {
        EXPECT_GT(requests[i].bytes(), 0);
        EXPECT_LE(requests[i].bytes(), kLongestRequest);
        if (i > 0) {
            EXPECT_GE(requests[i].begin, requests[i - 1].end);
        }
    }
    for (const FileRange& range : wanted) EXPECT_TRUE(covers(requests, range)) << range.begin << " to " << range.end;
}

TEST(RangePlan, SingleRequestsCoverWhatIsWantedAndWasteLittle) {
    std::mt19937_64 random(1);
    for (const std::int64_t gap : {std::int64_t{100}, kCheapGap, std::int64_t{1} << 20, std::int64_t{1} << 30}) {
        for (const std::size_t count : {1U, 2U, 12U, 13U, 500U}) {
            const std::vector<FileRange> wanted = random_ranges(random, count, gap);
            const std::vector<FileRange> requests = plan_requests(wanted);
            expect_sound(requests, wanted);
            const double most = std::max(kMostWaste * static_cast<double>(total(wanted)), static_cast<double>(kAlwaysWasted)) +
                                static_cast<double>(count * static_cast<std::size_t>(kCheapGap));
            EXPECT_LE(static_cast<double>(total(requests) - total(wanted)), most);
        }
    }
    EXPECT_TRUE(plan_requests({}).empty());
}

TEST(RangePlan, SetsOfRangesHoldWhatIsWantedAndLittleElse) {
    std::mt19937_64 random(2);
    for (const std::int64_t gap : {kPartGap, std::int64_t{1} << 20}) {
        for (const std::size_t count : {1U, 2U, 9U, 2000U}) {
            const std::vector<FileRange> wanted = random_ranges(random, count, gap);
            std::vector<FileRange> all;
            for (const auto& set : plan_range_sets(wanted, 6)) {
                EXPECT_FALSE(set.empty());
                EXPECT_LE(set.size(), kMostRanges);
                EXPECT_LE(total(set), kLongestRequest);
                all.insert(all.end(), set.begin(), set.end());
            }
            expect_sound(all, wanted);
            EXPECT_LE(total(all) - total(wanted), static_cast<std::int64_t>(count) * kPartGap);
        }
    }
}

TEST(RangePlan, WithoutLeavesTheBytesOfNoOther) {
    std::mt19937_64 random(3);
    for (int trial = 0; trial < 200; ++trial) {
        const std::vector<FileRange> ranges = random_ranges(random, 5, 3000);
        const std::int64_t moved = static_cast<std::int64_t>(random() % 20000) - 10000;
        std::vector<FileRange> others = random_ranges(random, 5, 3000);
        for (FileRange& other : others) other.begin += moved, other.end += moved;
        std::ranges::shuffle(others, random);
        const auto holds = [](const std::vector<FileRange>& all, std::int64_t byte) {
            return std::ranges::any_of(all, [&](const FileRange& r) { return r.begin <= byte && byte < r.end; });
        };
        const std::vector<FileRange> left = without(ranges, others);
        std::int64_t last = ranges.front().begin;
        for (const FileRange& range : left) {
            EXPECT_GE(range.begin, last);
            EXPECT_GT(range.bytes(), 0);
            last = range.end;
        }
        for (const auto& all : {ranges, others, left}) {
            for (const FileRange& range : all) {
                for (const std::int64_t byte : {range.begin - 1, range.begin, range.end - 1, range.end})
                    EXPECT_EQ(holds(left, byte), holds(ranges, byte) && !holds(others, byte)) << byte;
            }
        }
    }
}

}  // namespace
}  // namespace isoatlas
