// Which isovalues of the main branch get a line.
#include "features/main_branch_isovalues.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace isoatlas {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::int64_t kVoxels = 1'000'000;
using enum IsovalueReason;

std::vector<double> taus(const std::vector<BranchIsovalue>& isovalues, std::size_t count) {
    std::vector<double> result;
    for (std::size_t i = 0; i < count; ++i) result.push_back(isovalues[i].tau);
    return result;
}

TEST(MainBranchIsovalues, GoFromTheOutsideIn) {
    std::vector<BranchIsovalue> own{{kMainBranch, 50, kInfinity, stable, -1, 5000},
                                    {kMainBranch, 90, 2, stable, -1, 100},
                                    {kMainBranch, 20, 1, stable, -1, 90000},
                                    {kMainBranch, 2, 3, outline, -1, 300000}};
    ASSERT_EQ(arrange_main_branch(own, kVoxels), 4U);
    EXPECT_EQ(taus(own, 4), (std::vector<double>{2, 20, 50, 90}));
}

TEST(MainBranchIsovalues, EndWithTheBoxOfTheVolume) {
    std::vector<BranchIsovalue> own{
        {kMainBranch, 50, kInfinity, stable, -1, 5000}, {kMainBranch, 20, 1, stable, -1, 90000}, {kMainBranch, 2, 3, outline, -1, 900000}};
    ASSERT_EQ(arrange_main_branch(own, kVoxels), 3U);
    EXPECT_EQ(taus(own, 3), (std::vector<double>{20, 50, 2}));
}

// Inserts of an engine stand out at four isovalues, its block at one of little prominence.
TEST(MainBranchIsovalues, AreNotSpentOnWhatLooksTheSame) {
    std::vector<BranchIsovalue> own{{kMainBranch, 180, 3.7, stable, -1, 38000},       {kMainBranch, 244, 1.9, stable, -1, 1700},
                                    {kMainBranch, 218, 1.5, stable, -1, 16000},       {kMainBranch, 158, 1.1, stable, -1, 58000},
                                    {kMainBranch, 203, 0.9, stable, -1, 27000},       {kMainBranch, 72, 0.6, stable, -1, 1100000},
                                    {kMainBranch, 8, kInfinity, outline, -1, 1600000}};
    ASSERT_EQ(arrange_main_branch(own, 8 * kVoxels), 5U);
    EXPECT_EQ(taus(own, 7), (std::vector<double>{8, 72, 180, 218, 244, 158, 203}));
}

/// A main branch from 0 to 100 with a body of 1000 voxels from 80 on, and 10 more for every step below.
BranchHistogram main_branch() {
    BranchHistogram histogram(kMainBranch, 0, 100, true, HeightAxis({0, 100, 0}, 1));
    for (int value = 1; value <= 80; ++value) histogram.add(value, 10);
    histogram.add(90, 1000);
    return histogram;
}

BranchDecomposition with_other(double merges, std::int64_t voxels) {
    BranchDecomposition branches;
    branches.branch = IdArray<BranchId, Branch>(2);
    Branch &main = branches.branch[kMainBranch], &other = branches.branch[BranchId(1)];
    main = other = Branch{};
    main.parent = BranchId::none(), main.appears = 100, main.merges = -kInfinity;
    other.parent = kMainBranch, other.appears = 60, other.merges = merges, other.voxels = voxels;
    return branches;
}

TEST(MainBranchIsovalues, ShowItWithoutWhatJoinsIt) {
    const BranchHistogram histogram = main_branch();
    const std::vector<BranchIsovalue> own{{kMainBranch, 85.5, kInfinity, stable, -1, 1000}};
    const auto found = [&](double merges, std::int64_t voxels, double noise) {
        return before_merges(with_other(merges, voxels), {kMainBranch, BranchId(1)}, histogram, own, {.sigma = noise});
    };
    const std::vector<BranchIsovalue> joined = found(19.3, 500, 1);
    ASSERT_EQ(joined.size(), 1U);
    EXPECT_EQ(joined[0].reason, merge);
    EXPECT_EQ(joined[0].tau, 19.5);
    EXPECT_EQ(joined[0].volume, 1000 + 61 * 10);
    EXPECT_TRUE(found(19.3, 50, 1).empty()) << "what joins is small";
    EXPECT_TRUE(found(60, 500, 1).empty()) << "the main branch looks as it does at 85.5";
    EXPECT_TRUE(found(19.3, 500, 30).empty()) << "noise decides how large it is";
    EXPECT_TRUE(before_merges(with_other(19.3, 500), {kMainBranch}, histogram, own, {.sigma = 1}).empty()) << "the other one is not chosen";
}

}  // namespace
}  // namespace isoatlas
