// The theorems of docs/theory hold in the oracle itself: it is built from definitions only, so these are tests of the theory.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "oracle/bodies.h"
#include "oracle/compare.h"
#include "oracle/flooding.h"
#include "oracle/volumes.h"

namespace oracle {
namespace {

Elements arbitrary_elements(const Grid& grid) { return elements_of(grid, *arbitrary_interpolant()); }

// T1: #contours = #objects + #lows - 1, each contour touches one object and one low component, pairs are distinct;
// T2: every element does to chi what its type says; chi from contours equals chi counted cell by cell. At every cut of the order.
RC_GTEST_PROP(Oracle, T1AndT2HoldAtEveryCut, ()) { RC_ASSERT(analyse(arbitrary_elements(*arbitrary_grid())).consistent); }

/// The octahedral rule of section 3.
std::pair<int, int> type_by_neighbours(const Elements& elements, Index v) {
    int both = 0;
    for (int axis = 0; axis < elements.grid.rank; ++axis) {
        int above = 0;
        for (int side = 0; side < 2; ++side) {
            const Index w = elements.grid.neighbour(v, 2 * axis + side);
            above += w >= 0 && elements.rank_of[w] > elements.rank_of[v] ? 1 : 0;
        }
        if (above == 1) return {1, 1};
        both += above == 2 ? 1 : 0;
    }
    if (both == 0) return {0, 1};
    if (both == elements.grid.rank) return {1, 0};
    return elements.grid.rank == 2 ? std::pair{2, 2} : both == 1 ? std::pair{2, 1} : std::pair{1, 2};
}

void oracle_vertices_follow_the_octahedral_rule() {
    const Elements elements = arbitrary_elements(*arbitrary_grid());
    const Result result = analyse(elements);
    std::vector<std::pair<int, int>> found(static_cast<std::size_t>(elements.count()), {1, 1});
    for (const CriticalElement& c : result.critical) found[c.element] = {c.h0, c.l0};
    for (Index v = 0; v < elements.grid.voxels(); ++v) RC_ASSERT(found[v] == type_by_neighbours(elements, v));
    if (elements.grid.rank == 2) {
        for (Index e = elements.grid.voxels(); e < elements.count(); ++e) RC_ASSERT(found[e] == (std::pair{2, 2}));
    }
}

void oracle_levels_and_events_do_not_depend_on_numbering() {
    const Grid grid = *arbitrary_grid(5, 60);
    const auto [order, mirror] = *rc::gen::elementOf(turns(grid.rank));
    const Grid other = rotated(grid, order, mirror);
    const isoatlas::Interpolant interpolant = *arbitrary_interpolant();
    RC_ASSERT(canonical_text(analyse(elements_of(grid, interpolant))) == canonical_text(analyse(elements_of(other, interpolant))));
}

// Two vertices are in one object at a cut exactly when their labels climb to the same node: the dissertation's flooding gives the join
// tree.
void flooding_labels_give_the_objects_of_every_cut() {
    const Elements elements = arbitrary_elements(*arbitrary_grid(6, 60));
    const Result result = analyse(elements);
    const Flooding flooding = flood(elements, result.critical);
    for (Index cut = 0; cut < elements.count(); ++cut) {
        const Snapshot s = snapshot(elements, cut);
        std::vector<Index> node_of_object(s.objects.size(), -1), object_of_node(result.critical.size(), -1);
        for (Index e = 0; e < elements.count(); ++e) {
            if (s.object_of[e] < 0) continue;
            Index node = flooding.label[e];
            for (Index next = flooding.parent[node]; next >= 0 && elements.rank_of[result.critical[next].element] >= cut;
                 next = flooding.parent[node])
                node = next;
            Index& expected = node_of_object[s.object_of[e]];
            if (expected < 0) expected = node;
            RC_ASSERT(expected == node);
            Index& object = object_of_node[node];
            if (object < 0) object = s.object_of[e];
            RC_ASSERT(object == s.object_of[e]);
        }
    }
}

void flooding_without_ties_its_tree_is_the_event_tree() {
    const Elements elements = arbitrary_elements(without_ties(*arbitrary_grid(6, 80)));
    if (has_ties(elements)) return;  // two face points may share a value
    const Result result = analyse(elements);
    const Flooding flooding = flood(elements, result.critical);
    RC_ASSERT(result.events.size() == result.critical.size());
    for (std::size_t e = 0; e < result.events.size(); ++e) RC_ASSERT(result.events[e].parent == flooding.parent[e]);
    for (Index v = 0; v < elements.grid.voxels(); ++v) RC_ASSERT(result.zone[v] == flooding.label[v]);
}

RC_GTEST_PROP(Oracle, VerticesFollowTheOctahedralRule, ()) { oracle_vertices_follow_the_octahedral_rule(); }
RC_GTEST_PROP(Oracle, LevelsAndEventsDoNotDependOnNumbering, ()) { oracle_levels_and_events_do_not_depend_on_numbering(); }
RC_GTEST_PROP(Flooding, LabelsGiveTheObjectsOfEveryCut, ()) { flooding_labels_give_the_objects_of_every_cut(); }
RC_GTEST_PROP(Flooding, WithoutTiesItsTreeIsTheEventTree, ()) { flooding_without_ties_its_tree_is_the_event_tree(); }

}  // namespace
}  // namespace oracle
