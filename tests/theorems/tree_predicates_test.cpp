// The predicates of src/tree/predicates.h hold for the trees of every volume.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "analysis/analysis_data.h"
#include "analysis/trees.h"
#include "critical/bodies.h"
#include "critical/grid_domain.h"
#include "oracle/compare.h"
#include "oracle/volumes.h"
#include "tree/merge_tree.h"
#include "tree/predicates.h"
#include "tree/split_tree.h"

namespace oracle {
namespace {

using Id = std::uint32_t;
using isoatlas::Verdict;

/// All trees of a volume, each from the one before.
struct Trees {
    int rank;
    isoatlas::MergeTree<Id> join, split;
    isoatlas::ContourTree<Id> contours;
    isoatlas::ByElement<Id, std::int8_t> delta_chi;
    isoatlas::Analysis analysis;

    Trees(const Grid& grid, isoatlas::Interpolant interpolant)
        : rank(grid.rank), analysis(isoatlas::analyse(to_volume(grid), {.interpolant = interpolant})) {
        const isoatlas::GridView<double> view{grid.value.data(), {grid.rank, {grid.size}}};
        const double tunnel_height = isoatlas::tunnel_height_of(interpolant, 0);
        const auto set = isoatlas::GridDomain<double, Id>(view, isoatlas::scan_grid(view, tunnel_height, {})).critical(false, {}).set;
        if (rank == 3) delta_chi = isoatlas::delta_chis(set.code, 3);
        join = isoatlas::join_tree(set), split = isoatlas::split_tree(set);
        contours = isoatlas::contour_tree<Id>(join, isoatlas::split_tree(set), delta_chi);
    }
    [[nodiscard]] const isoatlas::AnalysisArrays<Id>& arrays() const { return std::get<0>(analysis.data().arrays)->arrays; }
};

Trees any_trees() { return {*arbitrary_grid(), *arbitrary_interpolant()}; }

void expect(const Verdict& verdict) {
    if (!verdict) RC_FAIL(verdict.violation());
}

void merge_trees_of_the_contour_tree_are_those_it_was_made_of(const Trees& trees) {
    RC_ASSERT(isoatlas::join_tree_of(trees.contours) == trees.join);
    RC_ASSERT(isoatlas::split_tree_of(trees.contours).parent == trees.split);
}

void every_level_has_one_value(const Trees& trees) {
    const auto& arrays = trees.arrays();
    expect(isoatlas::every_level_has_one_value<Id>(arrays.contours, arrays.level, arrays.value));
}

void every_event_has_its_zone(const Trees& trees) {
    expect(isoatlas::every_event_has_its_zone<Id>(trees.arrays().tree, trees.arrays().value));
}

void euler_numbers_add_up(const Trees& trees) {
    if (trees.rank == 3) expect(isoatlas::euler_numbers_add_up<Id>(trees.contours, trees.delta_chi));
}

void every_arc_has_one_contour(const Trees& trees) {
    expect(isoatlas::every_arc_has_one_contour<Id>(trees.contours, trees.join, trees.split));
}

RC_GTEST_PROP(TheJoinTree, IsAJoinTree, ()) { expect(isoatlas::is_join_tree<Id>(any_trees().join)); }
RC_GTEST_PROP(TheSplitTree, IsASplitTree, ()) { expect(isoatlas::is_split_tree<Id>(any_trees().split)); }
RC_GTEST_PROP(TheContourTree, IsAContourTree, ()) { expect(isoatlas::is_contour_tree(any_trees().contours)); }
RC_GTEST_PROP(TheContourTree, HasTheMergeTreesItWasMadeOf, ()) { merge_trees_of_the_contour_tree_are_those_it_was_made_of(any_trees()); }
RC_GTEST_PROP(TheContourTree, HasOneContourForEveryArc, ()) { every_arc_has_one_contour(any_trees()); }
RC_GTEST_PROP(TheContourTree, HasEulerNumbersThatAddUp, ()) { euler_numbers_add_up(any_trees()); }
RC_GTEST_PROP(TheContourTree, HasLevelsOfOneValue, ()) { every_level_has_one_value(any_trees()); }
RC_GTEST_PROP(TheCriticalityTree, HasAZoneForEveryEvent, ()) { every_event_has_its_zone(any_trees()); }

}  // namespace
}  // namespace oracle
