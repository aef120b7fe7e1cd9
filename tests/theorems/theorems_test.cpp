// The theorems of docs/theory as statements about the engine's answers, checked against explicit cuts. T8 is in stability_test.cpp.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "isoatlas/simplify.h"
#include "oracle/bodies.h"
#include "oracle/compare.h"
#include "oracle/volumes.h"

namespace oracle {
namespace {

struct Subject {
    Elements elements;
    isoatlas::Analysis analysis;
    explicit Subject(const Grid& grid, isoatlas::Interpolant interpolant = *arbitrary_interpolant())
        : elements(elements_of(grid, interpolant)), analysis(isoatlas::analyse(to_volume(grid), {.interpolant = interpolant})) {}

    template <class Function>
    void at_every_value(Function&& function) const {
        for (const double tau : interesting_values(elements)) function(tau, snapshot(elements, elements.cut_at(tau)));
    }
};

Subject any_subject() { return Subject(*arbitrary_grid()); }

bool is_inside(double tau, double low, double high) { return low < tau && tau <= high; }

template <class T>
std::vector<T> sorted(std::vector<T> list) {
    std::sort(list.begin(), list.end());
    return list;
}

// T1: #contours = #objects + #lows - 1.
void contours_are_objects_and_lows_less_one(const Subject& subject) {
    subject.at_every_value([&](double tau, const Snapshot& s) {
        Index contours = 0, objects = 0;
        for (Index i = 0; i < subject.analysis.contour_arc_count(); ++i) {
            const isoatlas::ContourArc arc = subject.analysis.contour_arc(i);
            contours += is_inside(tau, arc.value_low, arc.value_high) ? 1 : 0;
        }
        for (const isoatlas::EventId i : isoatlas::ids<isoatlas::EventId>(subject.analysis.event_count())) {
            const isoatlas::ZoneRange zone = subject.analysis.event(i).zone;
            objects += is_inside(tau, zone.tau_low, zone.tau_high) ? 1 : 0;
        }
        RC_ASSERT(objects == static_cast<Index>(s.objects.size()));
        RC_ASSERT(contours == objects + static_cast<Index>(s.lows.size()) - 1);
    });
}

// T2: when an element passes, the Euler number of the High set changes by l0 - h0 (2D: saddles -1, extrema +1).
void every_euler_number_is_a_sum_over_elements(const Subject& subject) {
    subject.at_every_value([&](double tau, const Snapshot& s) {
        Index chi = 0;
        for (const isoatlas::ElementId i : isoatlas::ids<isoatlas::ElementId>(subject.analysis.element_count())) {
            const isoatlas::Element e = subject.analysis.element(i);
            if (e.value < tau) continue;
            if (subject.elements.grid.rank == 3) chi += e.l0 - e.h0;
            if (subject.elements.grid.rank == 2) chi += e.h0 == 2 ? -1 : 1;
        }
        RC_ASSERT(chi == s.chi_by_cells);
    });
}

// T3: in its zone an object has chi = sum of delta_chi over its subtree, b2 = contours - 1, b1 = 1 + b2 - chi = sum of the genera (3D).
void every_object_is_a_sum_over_its_subtree(const Subject& subject) {
    const isoatlas::Analysis& a = subject.analysis;
    std::vector<Index> chi(static_cast<std::size_t>(a.event_count())), genera(chi.size());
    a.visit_object_contours([&](isoatlas::EventId event, std::span<const isoatlas::GenusCount> counts) {
        for (const isoatlas::GenusCount& c : counts) genera[event.index()] += c.genus * c.count;
    });
    for (const isoatlas::EventId i : isoatlas::ids<isoatlas::EventId>(a.event_count())) {
        const isoatlas::Event e = a.event(i);
        Index& own = chi[i.index()];
        own += e.delta_chi;
        if (e.parent.exists()) chi[e.parent.index()] += own;
        RC_ASSERT(e.chi == own);
        if (subject.elements.grid.rank == 3) {
            RC_ASSERT(e.b2 == e.contours - 1);
            RC_ASSERT(e.b1 == genera[i.index()]);
        } else {
            RC_ASSERT(e.b1 == e.contours - 1);
            RC_ASSERT(e.b2 == 0);
        }
        RC_ASSERT(e.chi == 1 - e.b1 + e.b2);
        RC_ASSERT(!e.parent.exists() == (i == isoatlas::EventId(a.event_count() - 1)));
        RC_ASSERT(!e.parent.exists() || (e.parent > i && a.event(e.parent).value < e.value));
    }
}

// T4: the genus of every contour-tree arc is that of the explicit surface.
void every_arc_has_the_genus_of_its_contour(const Subject& subject) {
    subject.at_every_value([&](double tau, const Snapshot& s) {
        std::vector<Index> expected, actual;
        for (const Contour& c : s.contours) expected.push_back(c.genus);
        for (Index i = 0; i < subject.analysis.contour_arc_count(); ++i) {
            const isoatlas::ContourArc arc = subject.analysis.contour_arc(i);
            if (is_inside(tau, arc.value_low, arc.value_high)) actual.push_back(arc.genus);
        }
        RC_ASSERT(sorted(actual) == sorted(expected));
    });
}

// T5: sum of genera out - in = m - k - D, summed over the levels of an event (3D).
void genera_change_by_contours_and_euler_number(const Subject& subject) {
    if (subject.elements.grid.rank != 3) return;
    const isoatlas::Analysis& a = subject.analysis;
    std::vector<Index> predicted(static_cast<std::size_t>(a.event_count()));
    for (Index i = 0; i < a.level_count(); ++i) {
        const isoatlas::Level level = a.level(i);
        Index change = 0;
        for (const Index g : level.out) change += g;
        for (const Index g : level.in) change -= g;
        RC_ASSERT(level.in.size() != 1 || level.out.size() != 1 || change != 0);  // trivial levels are not listed
        RC_ASSERT(level.value == a.event(level.event).value);
        predicted[level.event.index()] += static_cast<Index>(level.out.size()) - static_cast<Index>(level.in.size()) - change;
    }
    for (const isoatlas::EventId i : isoatlas::ids<isoatlas::EventId>(a.event_count()))
        RC_ASSERT(a.event(i).delta_chi == predicted[i.index()]);
}

// T6: climbing from the zones of two voxels down to tau meets the same event exactly when the voxels are in one object at tau.
void climbing_from_a_zone_finds_the_object(const Subject& subject) {
    const isoatlas::Analysis& a = subject.analysis;
    subject.at_every_value([&](double tau, const Snapshot& s) {
        std::vector<isoatlas::EventId> event_of(s.objects.size(), isoatlas::EventId::none());
        for (Index v = 0; v < subject.elements.grid.voxels(); ++v) {
            if (s.object_of[v] < 0) continue;
            isoatlas::EventId event = a.zone(isoatlas::VoxelId(v));
            while (a.event(event).zone.tau_low >= tau) event = a.event(event).parent;
            isoatlas::EventId& expected = event_of[s.object_of[v]];
            if (!expected.exists()) expected = event;
            RC_ASSERT(event == expected);
        }
        const std::vector<isoatlas::EventId> events = sorted(event_of);
        RC_ASSERT(std::adjacent_find(events.begin(), events.end()) == events.end());
    });
}

// T7: hypervolume, persistence and voxels grow towards the main branch.
void sizes_grow_towards_the_main_branch() {
    Grid grid = *arbitrary_grid();
    for (double& value : grid.value) value = std::floor(value);  // sums are exact
    const isoatlas::Volume volume = to_volume(grid);
    const isoatlas::BranchHierarchy hierarchy(volume, isoatlas::analyse(volume, {.interpolant = *arbitrary_interpolant()}));
    for (const isoatlas::BranchInfo& branch : hierarchy.branches()) {
        if (!branch.parent.exists()) continue;
        const isoatlas::BranchInfo& parent = hierarchy.branches()[branch.parent.index()];
        RC_ASSERT(parent.hypervolume >= branch.hypervolume);
        RC_ASSERT(parent.persistence >= branch.persistence);
        RC_ASSERT(parent.voxels >= branch.voxels);
    }
}

RC_GTEST_PROP(Theorem, T1_ContoursAreAsManyAsObjectsAndLowComponentsLessOne, ()) { contours_are_objects_and_lows_less_one(any_subject()); }
RC_GTEST_PROP(Theorem, T2_TheEulerNumberOfEveryCutIsASumOverElements, ()) { every_euler_number_is_a_sum_over_elements(any_subject()); }
RC_GTEST_PROP(Theorem, T3_EveryObjectIsASumOverItsSubtree, ()) { every_object_is_a_sum_over_its_subtree(any_subject()); }
RC_GTEST_PROP(Theorem, T4_EveryArcHasTheGenusOfItsContour, ()) { every_arc_has_the_genus_of_its_contour(any_subject()); }
RC_GTEST_PROP(Theorem, T5_GeneraOfEventsChangeByContoursAndEulerNumber, ()) { genera_change_by_contours_and_euler_number(any_subject()); }
RC_GTEST_PROP(Theorem, T6_ClimbingFromAZoneFindsTheObject, ()) { climbing_from_a_zone_finds_the_object(any_subject()); }
RC_GTEST_PROP(Theorem, T7_SizesGrowTowardsTheMainBranch, ()) { sizes_grow_towards_the_main_branch(); }

}  // namespace
}  // namespace oracle
