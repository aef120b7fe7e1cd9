// Parts of volumes drawn by hand (drawings.h): what a part decides on its own, and the contour tree of all parts.
#include "tree/reduce.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tree/assemble.h"
#include "tree/local_numbers.h"
#include "tree/marked_sets.h"
#include "unit/tree/drawings.h"

namespace isoatlas {
namespace {

/// The elements of a drawing cut into parts. The extrema of a part must have consecutive numbers.
struct Parts {
    PartitionedSet<Id> set;
    std::vector<std::uint16_t> part_of;

    Parts(const Drawing& drawing, std::vector<std::uint16_t> parts) : part_of(std::move(parts)) {
        Id maxima = 0, minima = 1;
        for (std::uint16_t part = 0; part <= *std::max_element(part_of.begin(), part_of.end()); ++part) {
            set.first.push_back(set.size());
            set.first_maximum.emplace_back(maxima), set.first_minimum.emplace_back(minima);
            for (std::size_t i = 0; i < part_of.size(); ++i) {
                if (part_of[i] != part) continue;
                set.elements.push_back(drawing.elements[i]);
                maxima += branches_above(drawing.elements[i].branches) == 0;
                minima += branches_below(drawing.elements[i].branches) == 0;
            }
        }
        set.first.push_back(set.size());
        set.first_maximum.emplace_back(maxima), set.first_minimum.emplace_back(minima);
    }

    [[nodiscard]] Ids contour_arcs_of_all() const { return list(contour_arcs<Id>(set, part_of, {})); }
};

struct Reduced {
    std::vector<DrawnElement> elements;
    std::vector<ElementKey> arc;

    Reduced(const Parts& parts, std::size_t part) {
        const auto own = parts.set.of(part, parts.set.elements);
        elements.assign(own.begin(), own.end());
        arc.assign(elements.size(), ElementKey(99));  // of survivors: left alone
        reduce_part<Id>(parts.set, part, open_extrema(parts.set, 1), elements, arc);
    }
    [[nodiscard]] bool survives(std::size_t x) const { return elements[x].branches != kRemoved; }
    [[nodiscard]] Ids arcs() const {
        const std::span<const Id> numbers = numbers_of<ElementKey>(arc);
        return {numbers.begin(), numbers.end()};
    }
    [[nodiscard]] std::array<Id, 2> above(std::size_t x) const { return numbers(elements[x].representatives.above); }
    [[nodiscard]] std::array<Id, 2> below(std::size_t x) const { return numbers(elements[x].representatives.below); }

private:
    template <class Extremum>
    static std::array<Id, 2> numbers(const std::array<Extremum, 2>& names) {
        return {names[0].number(), names[1].number()};
    }
};

using Pair = std::array<Id, 2>;

TEST(OpenExtrema, AreThoseThatOtherPartsReferTo) {
    const Parts parts(two_peaks(), {0, 1, 0});  // s lies beside A
    const OpenExtrema open = open_extrema(parts.set, 1);
    EXPECT_FALSE(open.maxima.has(0));
    EXPECT_TRUE(open.maxima.has(1));
    EXPECT_TRUE(open.minima.has(0));  // the outside
}

// All is decided but what becomes of the contour at the outside: 5 stays, as a leaf.
TEST(Reduction, OfAWholeVolumeLeavesTheContourAtTheOutside) {
    const Reduced body_alone(Parts(body(), {0, 0, 0, 0, 0, 0, 0}), 0);
    EXPECT_EQ(body_alone.arcs(), (Ids{2, 2, 3, 4, 5, 99, 5}));
    for (std::size_t x = 0; x < 7; ++x) EXPECT_EQ(body_alone.survives(x), x == 5) << x;
    EXPECT_EQ(body_alone.elements[5].branches, branches_of(0, 1));
    EXPECT_EQ(body_alone.below(5), (Pair{0, 0}));
}

//   A  |  B       part 0 | part 1: s is in part 0
//   `-s-'         A ends at s whatever B is; B is open, and what is left of s leads to it
TEST(Reduction, KeepsWhatAnOpenMaximumMeets) {
    const Parts parts(two_peaks(), {0, 1, 0});
    const Reduced left(parts, 0), right(parts, 1);
    EXPECT_EQ(left.arcs(), (Ids{1, 99}));
    EXPECT_FALSE(left.survives(0));
    EXPECT_EQ(left.elements[1].branches, branches_of(1, 1));
    EXPECT_EQ(left.above(1), (Pair{1, 1}));
    EXPECT_EQ(right.elements[0].branches, branches_of(0, 1));
    EXPECT_EQ(right.arcs(), (Ids{99}));
}

// The same from below: s and the minimum refer to extrema of each other's part, so nothing is decided.
TEST(Reduction, KeepsWhatAnOpenMinimumMeets) {
    const Parts parts(hollow_ball(), {0, 0, 1});
    const Reduced left(parts, 0), right(parts, 1);
    EXPECT_EQ(left.arcs(), (Ids{99, 99}));
    EXPECT_EQ(left.elements[1].branches, branches_of(1, 2));
    EXPECT_EQ(left.below(1), (Pair{0, 1}));
    EXPECT_EQ(right.elements[0].branches, branches_of(1, 0));
}

//   A   | part 0
//   s   | part 1 decides its cavity
//   | `-m
TEST(Reduction, RemovesACavityInsideThePart) {
    const Reduced lower(Parts(hollow_ball(), {0, 1, 1}), 1);
    EXPECT_EQ(lower.arcs(), (Ids{99, 0}));
    EXPECT_FALSE(lower.survives(1));
    EXPECT_EQ(lower.elements[0].branches, branches_of(1, 1));
    EXPECT_EQ(lower.above(0), (Pair{0, 0}));
    EXPECT_EQ(lower.below(0), (Pair{0, 0}));
}

// A handle names one object twice: it has one branch above.
TEST(Reduction, CountsABranchOnceThatIsNamedTwice) {
    const Drawing drawing{{peak(0), joins(0, 0), regular(0)}, {9, 8, 7}};
    const Parts parts(drawing, {0, 0, 1});
    const Reduced left(parts, 0);
    EXPECT_EQ(left.elements[1].branches, branches_of(1, 1));
    EXPECT_EQ(left.above(1), (Pair{0, 0}));
    EXPECT_TRUE(left.survives(0));  // part 1 refers to its maximum
}

TEST(Parts, HaveTheContourTreeOfTheWhole) {
    for (const Drawing& drawing : {two_peaks(), hollow_ball(), islands(), body()}) {
        const Ids expected = list(drawing.contours().other);
        const std::size_t n = drawing.elements.size();
        for (unsigned cut = 0; cut < 1U << (n - 1); ++cut) {  // every way to cut it in two, where numbers of extrema allow
            std::vector<std::uint16_t> part_of{0};
            for (std::size_t i = 1; i < n; ++i) part_of.push_back(static_cast<std::uint16_t>(cut >> (i - 1) & 1));
            std::vector<std::uint16_t> of_maxima;
            for (std::size_t i = 0; i < n; ++i) {
                if (branches_above(drawing.elements[i].branches) == 0) of_maxima.push_back(part_of[i]);
            }
            if (std::is_sorted(of_maxima.begin(), of_maxima.end())) {
                EXPECT_EQ(Parts(drawing, part_of).contour_arcs_of_all(), expected) << cut;
            }
        }
    }
}

TEST(LocalNumbers, PutTheOwnRangeFirst) {
    const LocalNumbers<Id> numbers(10, 13, {40, 7, 40});
    EXPECT_EQ(numbers.size(), 5U);
    EXPECT_EQ(numbers.own(), 3U);
    const Ids global{10, 11, 12, 7, 40};
    for (Id local = 0; local < 5; ++local) {
        EXPECT_EQ(numbers.global(local), global[local]);
        EXPECT_EQ(numbers.local(global[local]), local);
        EXPECT_EQ(numbers.is_own(global[local]), local < 3);
    }
}

TEST(MarkedSets, KeepTheMarkOfOneOfThoseThatJoin) {
    MarkedSets<Id> sets;
    sets.start(4, [](Id c) { return 10 * c; });
    const Id root = sets.join(sets.join(0, 1), 2);
    EXPECT_EQ(sets.find(0), root);
    EXPECT_EQ(sets.find(2), root);
    EXPECT_EQ(sets.mark(root), 10 * root);
    EXPECT_NE(sets.find(3), root);
    EXPECT_EQ(sets.join(root, root), root);
}

}  // namespace
}  // namespace isoatlas
