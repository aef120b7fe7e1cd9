// The contour tree of elements that are cut into parts is that of all elements at once, for every cut: slabs, and any other.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <numeric>

#include "base/paced_fill.h"
#include "critical/bodies.h"
#include "critical/grid_domain.h"
#include "oracle/volumes.h"
#include "tree/assemble.h"
#include "tree/contour_tree.h"
#include "tree/merge_tree.h"

namespace oracle {
namespace {

using Id = std::uint32_t;
using isoatlas::CriticalSet;
using isoatlas::ElementCode;

CriticalSet<Id> critical_set(const Grid& grid, isoatlas::Interpolant interpolant) {
    const isoatlas::GridView<double> view{grid.value.data(), {grid.rank, {grid.size}}};
    const double tunnel_height = isoatlas::tunnel_height_of(interpolant, 0);
    return isoatlas::GridDomain<double, Id>(view, isoatlas::scan_grid(view, tunnel_height, {})).critical(false, {}).set;
}

isoatlas::MergeTree<Id> expected_arcs(const CriticalSet<Id>& set) {
    return isoatlas::contour_tree<Id>(isoatlas::join_tree(set), isoatlas::split_tree(set), {}).other;
}

/// New numbers for extrema, so that those of a part follow each other. is_one(code): is it an extremum of the kind; name: by element, the
/// old number.
template <class Extremum>
struct Renumbered {
    isoatlas::IdArray<Extremum, Extremum> number;
    std::vector<Extremum> first;
    template <class IsOne>
    Renumbered(const CriticalSet<Id>& set, const std::vector<std::uint16_t>& part_of, int parts, Id min, const IsOne& is_one,
               const isoatlas::ByElement<Id, Extremum>& name)
        : number(isoatlas::filled(set.size() + 1, Extremum(0))) {
        Extremum next(min);
        for (int part = 0; part < parts; ++part) {
            first.push_back(next);
            for (const auto i : set.code.ids()) {
                if (part_of[i.index()] != part || !is_one(ElementCode{set.code[i]})) continue;
                number[name[i]] = next;
                ++next;
            }
        }
        first.push_back(next);
    }
};

isoatlas::PartitionedSet<Id> cut(const CriticalSet<Id>& set, const std::vector<std::uint16_t>& part_of, int parts) {
    const Renumbered maxima(set, part_of, parts, 0, [](ElementCode code) { return code.h0() == 0; }, set.up_a);
    const Renumbered minima(set, part_of, parts, 1, [](ElementCode code) { return code.l0() == 0; }, set.low_a);
    isoatlas::PartitionedSet<Id> result;
    result.first_maximum = maxima.first, result.first_minimum = minima.first;
    result.first.push_back(0);
    for (int part = 0; part < parts; ++part) {
        for (const auto i : set.code.ids()) {
            if (part_of[i.index()] != part) continue;
            const ElementCode code{set.code[i]};
            result.elements.push_back(
                {{{maxima.number[set.up_a[i]], maxima.number[set.up_b[i]]}, {minima.number[set.low_a[i]], minima.number[set.low_b[i]]}},
                 isoatlas::branches_of(code.h0(), code.l0())});
        }
        result.first.push_back(result.size());
    }
    return result;
}

void expect_same_arcs(const CriticalSet<Id>& set, const std::vector<std::uint16_t>& part_of, int parts) {
    const auto actual = isoatlas::contour_arcs<Id>(cut(set, part_of, parts), part_of, {});
    RC_ASSERT(actual == expected_arcs(set));
}

void trees_of_parts_cut_into_slabs_are_those_of_the_whole() {
    const Grid grid = *arbitrary_grid(7, 200);
    const CriticalSet<Id> set = critical_set(grid, *arbitrary_interpolant());
    for (const Index height : {1, 2, 3, 7}) {
        std::vector<std::uint16_t> part_of;
        for (const std::uint64_t bits : set.code.items()) {
            const ElementCode code{bits};
            const Index owner = code.is_body() ? code.cell() : code.kind() == isoatlas::CodeKind::face ? code.index() / 3 : code.index();
            part_of.push_back(static_cast<std::uint16_t>(owner / (grid.size[0] * grid.size[1]) / height));
        }
        expect_same_arcs(set, part_of, static_cast<int>((grid.size[2] + height - 1) / height));
    }
}

void trees_of_parts_cut_at_random_are_those_of_the_whole() {
    const CriticalSet<Id> set = critical_set(*arbitrary_grid(7, 200), *arbitrary_interpolant());
    for (const int parts : {1, 2, 3, 5, 20}) {
        const auto raw = *rc::gen::container<std::vector<int>>(set.size(), rc::gen::resize(100, rc::gen::inRange(0, parts)));
        expect_same_arcs(set, {raw.begin(), raw.end()}, parts);
    }
}

// Runs of neighbouring ranks in one part: much can be removed, and what is removed spans parts.
void trees_of_parts_cut_into_runs_are_those_of_the_whole() {
    const CriticalSet<Id> set = critical_set(*arbitrary_grid(7, 200), *arbitrary_interpolant());
    std::vector<std::uint16_t> part_of;
    while (part_of.size() < set.size()) {
        const int length = *rc::gen::resize(100, rc::gen::inRange(1, 60));
        part_of.insert(part_of.end(), static_cast<std::size_t>(length), static_cast<std::uint16_t>(*rc::gen::inRange(0, 3)));
    }
    part_of.resize(set.size());
    expect_same_arcs(set, part_of, 3);
}

RC_GTEST_PROP(TreesOfParts, CutIntoSlabsAreThoseOfTheWhole, ()) { trees_of_parts_cut_into_slabs_are_those_of_the_whole(); }
RC_GTEST_PROP(TreesOfParts, CutAtRandomAreThoseOfTheWhole, ()) { trees_of_parts_cut_at_random_are_those_of_the_whole(); }
RC_GTEST_PROP(TreesOfParts, CutIntoRunsAreThoseOfTheWhole, ()) { trees_of_parts_cut_into_runs_are_those_of_the_whole(); }

}  // namespace
}  // namespace oracle
