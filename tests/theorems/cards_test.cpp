// Cards against sets of voxels: lines of one object that share 60 % of their voxels or more are on one card.
#include "isoatlas/cards.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <set>

#include "isoatlas/cut.h"
#include "isoatlas/simplify.h"
#include "oracle/compare.h"
#include "oracle/volumes.h"

namespace oracle {
namespace {

using isoatlas::Card;
using isoatlas::ObjectEntry;
using isoatlas::ObjectTable;
using isoatlas::Volume;

std::set<Index> voxels_of(const Volume& volume, isoatlas::Interpolant interpolant, double tau, Index voxel) {
    const isoatlas::Cut cut = isoatlas::cut(volume, tau, {.interpolant = interpolant, .label = true});
    std::set<Index> voxels;
    for (Index v = 0; v < std::ssize(cut.label); ++v) {
        if (cut.label[static_cast<std::size_t>(v)] == cut.label[static_cast<std::size_t>(voxel)]) voxels.insert(v);
    }
    return voxels;
}

double overlap_of(const std::set<Index>& p, const std::set<Index>& q) {
    std::vector<Index> both;
    std::ranges::set_intersection(p, q, std::back_inserter(both));
    return static_cast<double>(both.size()) / static_cast<double>(p.size() + q.size() - both.size());
}

/// A table with a line for each of these: any objects at any of their isovalues.
struct Lines {
    ObjectTable table;
    std::vector<std::set<Index>> voxels;
    std::vector<std::int64_t> branch;
};

Lines any_lines(const Volume& volume, isoatlas::Interpolant interpolant) {
    const isoatlas::Analysis analysis = isoatlas::analyse(volume, {.interpolant = interpolant});
    const isoatlas::BranchHierarchy hierarchy(volume, analysis);
    const std::span<const isoatlas::BranchInfo> branches = hierarchy.branches();
    const int count = *rc::gen::inRange(1, 9);
    Lines lines;
    for (int i = 0; i < count; ++i) {
        const auto chosen = *rc::gen::inRange<std::size_t>(0, std::min<std::size_t>(branches.size(), 3));
        const isoatlas::BranchInfo& branch = branches[chosen];
        const auto [x, y, z] = analysis.event(branch.top).position;
        const Index top = volume.info.extent.index(std::lround(x), std::lround(y), std::lround(z));
        std::vector<double> taus{branch.appears};
        for (Index v = 0; v < volume.info.extent.voxels(); ++v) {
            if (volume.value(v) > branch.merges && volume.value(v) <= branch.appears) taus.push_back(volume.value(v));
        }
        const double tau = *rc::gen::elementOf(taus);
        lines.voxels.push_back(voxels_of(volume, interpolant, tau, top));
        ObjectEntry entry{};
        entry.id = top, entry.branch_top = branch.top, entry.best_tau = tau, entry.merges = branch.merges, entry.appears = branch.appears;
        entry.voxels = static_cast<std::int64_t>(lines.voxels.back().size());
        entry.outline = *rc::gen::arbitrary<bool>();
        lines.table.entries.push_back(entry);
        lines.branch.push_back(static_cast<std::int64_t>(chosen));
    }
    return lines;
}

RC_GTEST_PROP(Cards, AreSharedByOverlapOfVoxelSets, ()) {
    const Volume volume = to_volume(*arbitrary_grid(6, 150));
    const Lines lines = any_lines(volume, *arbitrary_interpolant());
    const std::vector<Card> cards = isoatlas::cards_of(lines.table, volume.info.extent);
    RC_ASSERT(cards.size() == lines.voxels.size());
    for (std::size_t i = 0; i < cards.size(); ++i) {
        const auto is_background = [&](std::size_t k) {
            return lines.table.entries[k].outline && 3 * std::ssize(lines.voxels[k]) > 2 * volume.info.extent.voxels();
        };
        Card expected{.line = i, .is_background = is_background(i)};
        double most = 0;
        for (std::size_t k = 0; k < i; ++k) {
            const bool may_hold = cards[k].line == k && lines.branch[k] == lines.branch[i] && is_background(k) == is_background(i);
            const double overlap = overlap_of(lines.voxels[i], lines.voxels[k]);
            if (may_hold && overlap >= isoatlas::kSameShape && overlap > most) expected.line = k, expected.overlap = most = overlap;
        }
        RC_ASSERT(cards[i] == expected);
    }
}

/// The lines of tables as they are: what they show is what they say.
RC_GTEST_PROP(Cards, OfTablesAreThoseOfTheirVoxels, ()) {
    const Volume volume = to_volume(*arbitrary_grid(7, 300));
    const isoatlas::Interpolant interpolant = *arbitrary_interpolant();
    const isoatlas::Analysis analysis = isoatlas::analyse(volume, {.interpolant = interpolant});
    const ObjectTable table = isoatlas::rank_objects(volume, analysis, {.top = 0, .gate = false});
    const std::vector<Card> cards = isoatlas::cards_of(table, volume.info.extent);
    std::vector<std::set<Index>> voxels;
    for (const ObjectEntry& entry : table.entries) voxels.push_back(voxels_of(volume, interpolant, entry.best_tau, entry.id));
    for (std::size_t i = 0; i < cards.size(); ++i) {
        RC_ASSERT(cards[i].overlap == overlap_of(voxels[i], voxels[cards[i].line]));
        for (std::size_t k = 0; k < i; ++k) {
            const bool both = cards[i].line == i && cards[k].line == k && table.entries[i].branch_top == table.entries[k].branch_top;
            if (both && cards[i].is_background == cards[k].is_background)
                RC_ASSERT(overlap_of(voxels[i], voxels[k]) < isoatlas::kSameShape);
        }
        const std::size_t top = 1 + i;
        const std::vector<Card> first = isoatlas::cards_of(first_entries(table, static_cast<std::int64_t>(top)), volume.info.extent);
        RC_ASSERT(std::ranges::equal(first, std::span(cards).first(top)));
    }
}

/// 10 voxels in a row, brightest at one end, as one object at several isovalues.
ObjectTable row_at(const std::vector<std::pair<std::int64_t, bool>>& lines) {
    ObjectTable table;
    for (const auto& [voxels, outline] : lines) {
        ObjectEntry entry{};
        entry.branch_top = isoatlas::EventId(0), entry.voxels = voxels, entry.outline = outline;
        table.entries.push_back(entry);
    }
    return table;
}

std::vector<std::size_t> lines_of(const ObjectTable& table) {
    std::vector<std::size_t> lines;
    for (const Card& card : isoatlas::cards_of(table, {3, {10, 1, 1}})) lines.push_back(card.line);
    return lines;
}

TEST(Cards, GoToTheLineThatResemblesMost) {
    EXPECT_EQ(lines_of(row_at({{10, false}, {6, false}})), (std::vector<std::size_t>{0, 0}));  // 60 % are the same
    EXPECT_EQ(lines_of(row_at({{10, false}, {5, false}})), (std::vector<std::size_t>{0, 1}));
    EXPECT_EQ(lines_of(row_at({{10, false}, {5, false}, {6, false}})), (std::vector<std::size_t>{0, 1, 1}));  // 5 of 6, not 6 of 10
    EXPECT_EQ(lines_of(row_at({{10, false}, {7, false}, {5, false}})), (std::vector<std::size_t>{0, 0, 2}));  // a line is no card
}

TEST(Cards, KeepTheScannedFieldApart) {
    const ObjectTable table = row_at({{7, false}, {9, true}, {8, true}, {6, true}});  // an outline of 60 % is none of the field
    EXPECT_EQ(lines_of(table), (std::vector<std::size_t>{0, 1, 1, 0}));
    const std::vector<Card> cards = isoatlas::cards_of(table, {3, {10, 1, 1}});
    EXPECT_TRUE(cards[1].is_background && cards[2].is_background);
    EXPECT_FALSE(cards[0].is_background || cards[3].is_background);
}

TEST(Cards, OfStoresThatDoNotSayWhichObjectItIsAreTheirOwn) {
    ObjectTable table = row_at({{7, false}, {7, false}});
    for (ObjectEntry& entry : table.entries) entry.branch_top = isoatlas::EventId::none();
    EXPECT_EQ(lines_of(table), (std::vector<std::size_t>{0, 1}));
}

}  // namespace
}  // namespace oracle
