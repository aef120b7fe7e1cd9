// The trees alone know every object and contour that a cut of the volume finds, at every isovalue.
#include "isoatlas/active.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <map>
#include <set>

#include "oracle/bodies.h"
#include "oracle/compare.h"
#include "oracle/difference.h"
#include "oracle/volumes.h"

namespace oracle {
namespace {

using isoatlas::ActiveIndex;
using isoatlas::ActiveObjects;
using isoatlas::Cut;

std::string text_of(Index id, Index chi, Index b1, Index b2, Index contours) {
    return std::to_string(id) + ": " + join(std::vector<Index>{chi, b1, b2, contours});
}
template <class Contour>
std::string text_of(const Contour& c) {
    return join(std::vector<Index>{c.id, c.object, static_cast<Index>(c.shell), c.genus});
}

std::set<std::string> objects_of(const Cut& cut) {
    std::set<std::string> all;
    for (const auto& o : cut.objects) all.insert(text_of(o.id, o.chi, o.b1, o.b2, o.contour_count));
    for (const auto& c : cut.contours) all.insert(text_of(c));
    return all;
}
std::set<std::string> objects_of(const ActiveObjects& active) {
    std::set<std::string> all;
    for (const auto& o : active.objects) all.insert(text_of(o.id, o.chi, o.b1, o.b2, o.contours));
    for (const auto& c : active.contours) all.insert(text_of(c));
    return all;
}

/// Outer contour first, then cavities by id, behind each other in the order of the objects.
void check_order(const ActiveObjects& active) {
    Index next = 0;
    for (const auto& object : active.objects) {
        RC_ASSERT(object.first_contour == next);
        for (Index i = 0; i < object.contours; ++i, ++next) {
            const auto& contour = active.contours[static_cast<std::size_t>(next)];
            RC_ASSERT(contour.object == object.id);
            RC_ASSERT((contour.shell == isoatlas::Shell::outer) == (i == 0));
            if (i > 1) RC_ASSERT(active.contours[static_cast<std::size_t>(next - 1)].id < contour.id);
        }
    }
    RC_ASSERT(next == static_cast<Index>(active.contours.size()));
    RC_ASSERT(next == active.contour_count);
}

void active_objects_of_the_trees_are_those_of_the_cut() {
    const Grid grid = *arbitrary_grid(7, 216);
    const isoatlas::Interpolant interpolant = *arbitrary_interpolant();
    const double height = *rc::gen::element(0.0, 0.0, 1.0);
    const isoatlas::Volume volume = to_volume(grid);
    const isoatlas::Analysis analysis = isoatlas::analyse(volume, {.interpolant = interpolant, .tunnel_height = height});
    const bool integers = std::all_of(grid.value.begin(), grid.value.end(), [](double v) { return v == std::floor(v); });
    const ActiveIndex index(analysis);
    for (const double tau : interesting_values(elements_of(grid, interpolant, height))) {
        const Cut cut = isoatlas::cut(volume, tau, {.interpolant = interpolant, .tunnel_height = height});
        const ActiveObjects active = index.at(tau, {.integer_samples = integers});
        RC_ASSERT(objects_of(active) == objects_of(cut));
        RC_ASSERT(active.objects.size() == cut.objects.size());
        check_order(active);
        std::map<Index, Index> voxels;
        for (const auto& object : cut.objects) voxels[object.id] = object.voxels;
        bool all_known = true;
        for (const auto& object : active.objects) {
            RC_ASSERT(object.zone.tau_low < tau);
            RC_ASSERT(tau <= object.zone.tau_high);
            RC_ASSERT(object.min_voxels <= voxels[object.id]);
            RC_ASSERT(object.max_voxels >= voxels[object.id]);
            all_known = all_known && object.min_voxels == object.max_voxels;
        }
        for (std::size_t i = 0; all_known && i < active.objects.size(); ++i) RC_ASSERT(active.objects[i].id == cut.objects[i].id);
        const ActiveObjects brief = index.at(tau, {.contours = false});
        RC_ASSERT(brief.contours.empty());
        RC_ASSERT(brief.contour_count == active.contour_count);
    }
}

/// Ids of the objects at `upper` by the object at a lower isovalue that contains their highest voxel: a second cut with labels.
std::map<Index, std::vector<Index>> groups_of(const Cut& upper, const Cut& lower) {
    std::map<Index, std::vector<Index>> groups;
    for (const auto& object : lower.objects) groups[object.id];
    for (const auto& object : upper.objects) {
        const auto position = static_cast<std::size_t>(lower.label[static_cast<std::size_t>(object.id)]);
        groups[lower.objects[position].id].push_back(object.id);
    }
    for (auto& [id, list] : groups) std::sort(list.begin(), list.end());
    return groups;
}

void active_objects_show_what_changes_between_two_isovalues() {
    const Grid grid = *arbitrary_grid(6, 150);
    const isoatlas::Interpolant interpolant = *arbitrary_interpolant();
    const isoatlas::Volume volume = to_volume(grid);
    const isoatlas::Analysis analysis = isoatlas::analyse(volume, {.interpolant = interpolant});
    const ActiveIndex index(analysis);
    const std::vector<double> values = interesting_values(elements_of(grid, interpolant));
    const double one = *rc::gen::elementOf(values), other = *rc::gen::elementOf(values);
    const isoatlas::CutOptions options{.interpolant = interpolant, .label = true};
    const Cut upper = isoatlas::cut(volume, std::max(one, other), options), lower = isoatlas::cut(volume, std::min(one, other), options);
    const std::map<Index, std::vector<Index>> expected = groups_of(upper, lower);
    const isoatlas::ObjectChanges all = index.changes(one, other, true), few = index.changes(other, one);
    RC_ASSERT(all.groups.size() == expected.size());
    Index appeared = 0, changed = 0;
    for (const auto& group : all.groups) {
        RC_ASSERT(group.upper == expected.at(group.lower));
        appeared += group.upper.empty();
        changed += group.changes;
        if (group.changes || group.upper.size() != 1) continue;
        const auto find = [](const Cut& cut, Index id) {
            return *std::find_if(cut.objects.begin(), cut.objects.end(), [id](const auto& o) { return o.id == id; });
        };
        const auto before = find(upper, group.upper[0]), after = find(lower, group.lower);
        RC_ASSERT(before.b1 == after.b1);
        RC_ASSERT(before.b2 == after.b2);
    }
    RC_ASSERT(all.appeared == appeared);
    RC_ASSERT(static_cast<Index>(upper.objects.size()) + all.appeared - all.merged == static_cast<Index>(lower.objects.size()));
    RC_ASSERT(static_cast<Index>(few.groups.size()) == changed);
}

// Going down from above everything meets the value of every event once, going up meets them in the other order.
void active_objects_of_the_trees_walk_from_event_to_event() {
    const Grid grid = *arbitrary_grid(6, 120);
    const isoatlas::Analysis analysis = isoatlas::analyse(to_volume(grid));
    const ActiveIndex index(analysis);
    std::vector<double> expected;
    for (const isoatlas::EventId e : isoatlas::ids<isoatlas::EventId>(analysis.event_count())) {
        if (expected.empty() || expected.back() != analysis.event(e).value) expected.push_back(analysis.event(e).value);
    }
    double tau = expected.front() + 1;
    RC_ASSERT(!index.event_above(tau));
    std::vector<double> down;
    while (const auto next = index.event_below(tau)) down.push_back(tau = *next);
    RC_ASSERT(down == expected);
    tau -= 1;
    std::vector<double> up{down.back()};
    while (const auto next = index.event_above(tau)) up.push_back(tau = *next);
    RC_ASSERT(up == std::vector<double>(expected.rbegin(), expected.rend()));
}

RC_GTEST_PROP(ActiveObjectsOfTheTrees, AreThoseOfTheCut, ()) { active_objects_of_the_trees_are_those_of_the_cut(); }
RC_GTEST_PROP(ActiveObjectsOfTheTrees, ShowWhatChangesBetweenTwoIsovalues, ()) { active_objects_show_what_changes_between_two_isovalues(); }
RC_GTEST_PROP(ActiveObjectsOfTheTrees, WalkFromEventToEvent, ()) { active_objects_of_the_trees_walk_from_event_to_event(); }

}  // namespace
}  // namespace oracle
