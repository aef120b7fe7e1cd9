// The proposed transfer function: a colour for each object, between its isovalue and the next one.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <set>

#include "isoatlas/render.h"

namespace isoatlas {
namespace {

constexpr std::array<double, 2> kSampleRange{0, 1000};
constexpr double kSkin = 100;  // a tenth of the range

VolumeInfo info_of(std::int64_t voxels) {
    VolumeInfo info;
    info.extent = {.rank = 3, .size = {voxels, 1, 1}};
    return info;
}

ObjectEntry entry_at(double tau, double appears, std::int64_t voxels) {
    ObjectEntry entry{};
    entry.best_tau = tau, entry.appears = appears, entry.voxels = voxels, entry.measure = static_cast<double>(voxels);
    return entry;
}

ObjectTable any_table() {
    ObjectTable table;
    for (int i = *rc::gen::inRange(0, 6); i > 0; --i) {
        const int tau = *rc::gen::inRange(10, 900);
        table.entries.push_back(entry_at(tau, tau + *rc::gen::inRange(1, 1000 - tau), *rc::gen::inRange(1, 500)));
        table.entries.back().branch_top = EventId(*rc::gen::inRange(0, 2));
        for (int n = *rc::gen::inRange(0, 3); n > 0; --n) {
            table.isovalues.push_back({.branch_top = table.entries.back().branch_top.number(),
                                       .tau = static_cast<double>(*rc::gen::inRange(10, 1000)),
                                       .prominence = 1,
                                       .reason = IsovalueReason::stable});
        }
    }
    return table;
}

/// The bumps of one isovalue: a skin, and maybe a body.
std::vector<std::vector<OpacityTent>> by_isovalue(const std::vector<OpacityTent>& tents) {
    std::vector<std::vector<OpacityTent>> groups;
    for (const OpacityTent& bump : tents) {
        if (groups.empty() || groups.back()[0].tau != bump.tau) groups.emplace_back();
        groups.back().push_back(bump);
    }
    return groups;
}

RC_GTEST_PROP(ProposedTransfer, SkinsAscendAndTheLastOneIsSolid, ()) {
    const ObjectTable table = any_table();
    const auto groups = by_isovalue(propose_transfer(table, info_of(1000), kSampleRange));
    RC_ASSERT(groups.empty() == table.entries.empty());
    std::set<std::array<double, 3>> colours;
    for (std::size_t i = 0; i < groups.size(); ++i) {
        const OpacityTent& skin = groups[i][0];
        RC_ASSERT(skin.low < skin.tau && skin.tau < skin.high && skin.low > skin.tau - kSkin / 2);
        RC_ASSERT(skin.ramp >= 0 && skin.ramp <= 0.5);
        RC_ASSERT(colours.insert({skin.colour.red, skin.colour.green, skin.colour.blue}).second);
        RC_ASSERT(std::ranges::count(table.entries, skin.tau, &ObjectEntry::best_tau) > 0);
        if (i + 1 == groups.size()) {
            RC_ASSERT(skin.high > kSampleRange[1]);
        } else {
            RC_ASSERT(skin.high <= groups[i + 1][0].tau && skin.density < groups[i + 1][0].density);
        }
    }
}

RC_GTEST_PROP(ProposedTransfer, BodiesReachToWhatComesNext, ()) {
    const ObjectTable table = any_table();
    for (const auto& group : by_isovalue(propose_transfer(table, info_of(1000), kSampleRange))) {
        RC_ASSERT(group.size() <= 2);
        if (group.size() == 1) continue;
        const OpacityTent &skin = group[0], &body = group[1];
        RC_ASSERT(body.low == skin.low && body.high > skin.high && body.colour == skin.colour && body.density <= skin.density);
        double next = kSampleRange[1];
        for (const ObjectEntry& other : table.entries) {
            if (other.best_tau > skin.tau) next = std::min(next, other.best_tau);
        }
        RC_ASSERT(body.high <= next);
        const bool its_own = std::ranges::any_of(table.isovalues, [&](const auto& isovalue) { return isovalue.tau == body.high; });
        const bool its_top = std::ranges::any_of(table.entries, [&](const auto& e) { return e.appears == body.high; });
        RC_ASSERT(body.high == next || its_own || its_top);
    }
}

TEST(ProposedTransfer, BackgroundOnlyIfThereIsNothingElse) {
    ObjectTable table;
    table.entries = {entry_at(300, 900, 950)};
    table.entries[0].outline = true;
    EXPECT_EQ(propose_transfer(table, info_of(1000), kSampleRange).size(), 1U);
    EXPECT_TRUE(is_background(table, 0, info_of(1000).extent));
    table.entries.push_back(entry_at(600, 900, 200));
    const std::vector<OpacityTent> tents = propose_transfer(table, info_of(1000), kSampleRange);
    ASSERT_EQ(tents.size(), 1U);
    EXPECT_EQ(tents[0].tau, 600);
    // An outline of less shows something; what fills the volume and is no outline does too.
    table.entries[0].voxels = 600;
    EXPECT_EQ(propose_transfer(table, info_of(1000), kSampleRange)[0].tau, 300);
    table.entries[0].voxels = 950, table.entries[0].outline = false;
    EXPECT_EQ(propose_transfer(table, info_of(1000), kSampleRange)[0].tau, 300);
}

TEST(ProposedTransfer, ARoomBetweenTwoIsovaluesHasThinMatter) {
    ObjectTable table;
    table.entries = {entry_at(200, 900, 8000), entry_at(700, 900, 100)};
    const std::vector<OpacityTent> tents = propose_transfer(table, info_of(100000), kSampleRange);
    ASSERT_EQ(tents.size(), 3U);
    EXPECT_EQ(tents[1].high, 700);
    EXPECT_DOUBLE_EQ(tents[1].density * 20, 0.5);  // across a cube of 8000
}

}  // namespace
}  // namespace isoatlas
