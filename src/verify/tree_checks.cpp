#include "verify/tree_checks.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "analysis/analysis_data.h"
#include "analysis/trees.h"
#include "tree/predicates.h"
#include "tree/split_tree.h"
#include "verify/checks.h"

namespace isoatlas {
namespace {

std::string event_name(EventId id) { return "event " + std::to_string(id.number()); }

std::string number(double value) {
    std::string text(32, '\0');
    text.resize(static_cast<std::size_t>(std::snprintf(text.data(), text.size(), "%.9g", value)));
    return text;
}

void check_children(const Analysis& analysis, const Event& event, Check& check) {
    for (const EventId child : event.children) {
        if (child < EventId(0) || child >= event.id) {
            check.fail(event_name(event.id) + " has the impossible child " + std::to_string(child.number()));
        } else if (analysis.event(child).parent != event.id) {
            check.fail(event_name(child) + " does not call " + event_name(event.id) + " its parent");
        }
    }
    if (event.objects_in != static_cast<std::int64_t>(event.children.size())) check.fail(event_name(event.id) + " miscounts its children");
}

/// What a predicate of trees (tree/predicates.h) finds in the arrays of an analysis.
template <class Predicate>
void check_arrays(const Analysis& analysis, Check& check, const Predicate& predicate) {
    const Verdict verdict = analysis.data().visit([&](const auto& held) { return predicate(held.arrays); });
    if (!verdict) check.fail(verdict.violation());
}

template <class Id>
Verdict is_contour_tree_with_levels(const AnalysisArrays<Id>& arrays) {
    if (Verdict verdict = is_contour_tree(arrays.contours); !verdict) return verdict;
    const MergeTree<Id> join = join_tree_of(arrays.contours);
    const SplitTree<Id> split = split_tree_of(arrays.contours);
    if (Verdict verdict = every_arc_has_one_contour<Id>(arrays.contours, join, split.parent); !verdict) return verdict;
    return every_level_has_one_value<Id>(arrays.contours, arrays.level, arrays.value);
}

/// Euler number of closed surfaces of these genera; the High set below has half of it (no contribution of curves in 2D).
std::int64_t surface_chi(const std::vector<std::int64_t>& genera) {
    std::int64_t chi = 0;
    for (const std::int64_t genus : genera) chi += 2 - 2 * genus;
    return chi;
}

}  // namespace

CheckResult join_tree_is_valid(const Analysis& analysis) {
    Check check("join_tree_is_valid");
    const std::int64_t count = analysis.event_count();
    check_arrays(analysis, check,
                 []<class Id>(const AnalysisArrays<Id>& arrays) { return every_event_has_its_zone<Id>(arrays.tree, arrays.value); });
    if (!check.holds()) return check.result(std::to_string(count) + " events");
    std::int64_t children = 0;
    for (const EventId id : ids<EventId>(count)) {
        const Event event = analysis.event(id);
        if (event.id != id) check.fail(event_name(id) + " has the id " + std::to_string(event.id.number()));
        children += event.objects_in;
        check_children(analysis, event, check);
        const double low = event.parent.exists() ? analysis.event(event.parent).value : -INFINITY;
        if (event.zone.tau_high != event.value || event.zone.tau_low != low)
            check.fail("the zone of " + event_name(id) + " is not between it and its parent");
    }
    if (count > 0 && children != count - 1) check.fail("an event is not the child of exactly one other");
    return check.result(std::to_string(count) + " events");
}

CheckResult zones_partition_voxels(const Analysis& analysis, const Volume& volume) {
    Check check("zones_partition_voxels");
    const std::int64_t count = analysis.event_count();
    std::vector<std::int64_t> voxels(static_cast<std::size_t>(count), 0);
    std::vector<ZoneRange> ranges;
    for (const EventId id : ids<EventId>(count)) ranges.push_back(analysis.event(id).zone);
    visit_samples(volume, [&](auto samples) {
        for (std::size_t i = 0; i < samples.size(); ++i) {
            const EventId zone = analysis.zone(VoxelId(i));
            if (zone < EventId(0) || zone >= EventId(count)) {
                check.fail("voxel " + std::to_string(i) + " has the impossible zone " + std::to_string(zone.number()));
                continue;
            }
            const ZoneRange& range = ranges[zone.index()];
            const auto value = static_cast<double>(samples[i]);
            if (!(value > range.tau_low && value <= range.tau_high)) {
                check.fail("voxel " + std::to_string(i) + " with value " + number(value) + " lies outside the interval of its zone " +
                           std::to_string(zone.number()));
            }
            ++voxels[zone.index()];
        }
    });
    for (std::int64_t id = 0; id < count; ++id) {
        const auto i = static_cast<std::size_t>(id);
        if (voxels[i] != ranges[i].voxels) check.fail("zone " + std::to_string(id) + " miscounts its voxels");
    }
    return check.result(std::to_string(volume.info.extent.voxels()) + " voxels in " + std::to_string(count) + " zones");
}

CheckResult euler_sums_hold(const Analysis& analysis) {
    Check check("euler_sums_hold");
    const bool flat = analysis.extent().rank == 2;
    if (!flat) {
        check_arrays(analysis, check, []<class Id>(const AnalysisArrays<Id>& arrays) {
            return euler_numbers_add_up<Id>(arrays.contours, delta_chis(arrays.code, 3));
        });
    }
    analysis.visit_object_contours([&](EventId id, std::span<const GenusCount> genera) {
        const Event event = analysis.event(id);
        std::int64_t chi = event.delta_chi, voxels = event.zone.voxels, contours = 0, genus = 0;
        for (const EventId child : event.children) {
            chi += analysis.event(child).chi;
            voxels += analysis.event(child).object_voxels;
        }
        for (const GenusCount& entry : genera) {
            contours += entry.count;
            genus += entry.genus * entry.count;
        }
        if (chi != event.chi) check.fail("the Euler number of " + event_name(id) + " is not the sum of its children's and its own change");
        if (event.chi != 1 - event.b1 + event.b2) check.fail(event_name(id) + ": chi is not 1 - b1 + b2");
        if (voxels != event.object_voxels) check.fail(event_name(id) + ": the voxels of children and zone are not those of the object");
        if (contours != event.contours || contours != 1 + (flat ? event.b1 : event.b2))
            check.fail(event_name(id) + " miscounts its contours");
        if (!flat && genus != event.b1) check.fail(event_name(id) + ": the genera of its contours do not add up to b1");
    });
    if (analysis.event_count() > 0) {
        const Event root = analysis.event(EventId(analysis.event_count() - 1));
        if (root.chi != 1 || root.b1 != 0 || root.b2 != 0 || root.contours != 1) check.fail("the root is not a solid box");
        if (root.object_voxels != analysis.extent().voxels()) check.fail("the root does not hold all voxels");
    }
    return check.result(std::to_string(analysis.event_count()) + " objects");
}

CheckResult contour_tree_is_a_tree(const Analysis& analysis) {
    Check check("contour_tree_is_a_tree");
    const ElementId outside(analysis.element_count());
    const std::int64_t arcs = analysis.contour_arc_count();
    check_arrays(analysis, check, [](const auto& arrays) { return is_contour_tree_with_levels(arrays); });
    if (!check.holds()) return check.result(std::to_string(arcs) + " arcs");
    std::int64_t to_outside = 0;
    for (std::int64_t id = 0; id < arcs; ++id) {
        const ContourArc arc = analysis.contour_arc(id);
        const std::string name = "arc " + std::to_string(id);
        if (arc.upper < ElementId(0) || arc.upper >= outside || arc.lower <= arc.upper || arc.lower > outside) {
            check.fail(name + " has impossible ends");
            continue;
        }
        to_outside += arc.lower == outside ? 1 : 0;
        const double low = arc.lower == outside ? -INFINITY : analysis.element(arc.lower).value;
        if (arc.value_high != analysis.element(arc.upper).value || arc.value_low != low)
            check.fail(name + " has other values than its ends");
        if (!(arc.value_low < arc.value_high)) check.fail(name + " has no length");
        if (arc.genus < 0) check.fail(name + " has a negative genus");
    }
    if (to_outside != 1) check.fail(std::to_string(to_outside) + " arcs run to the outside");
    return check.result(std::to_string(arcs) + " arcs");
}

CheckResult levels_match_events(const Analysis& analysis) {
    Check check("levels_match_events");
    const std::int64_t events = analysis.event_count(), levels = analysis.level_count();
    const bool flat = analysis.extent().rank == 2;
    std::vector<std::int64_t> own(static_cast<std::size_t>(events), 0), change(own), more(own);
    double previous = INFINITY;
    for (std::int64_t id = 0; id < levels; ++id) {
        const Level level = analysis.level(id);
        const std::string name = "level " + std::to_string(id);
        if (level.value > previous) check.fail(name + " is above the one before");
        previous = level.value;
        if (level.event < EventId(0) || level.event >= EventId(events) || analysis.event(level.event).value != level.value) {
            check.fail(name + " belongs to no event of its value");
            continue;
        }
        if (!std::is_sorted(level.in.begin(), level.in.end()) || !std::is_sorted(level.out.begin(), level.out.end()))
            check.fail(name + " is not sorted");
        if (level.in.size() == 1 && level.in == level.out) check.fail(name + " is trivial");
        ++own[level.event.index()];
        change[level.event.index()] += surface_chi(level.out) - surface_chi(level.in);
        more[level.event.index()] += static_cast<std::int64_t>(level.out.size()) - static_cast<std::int64_t>(level.in.size());
    }
    for (const EventId id : ids<EventId>(events)) {
        const std::size_t i = id.index();
        const Event event = analysis.event(id);
        std::int64_t contours = more[i];
        for (const EventId child : event.children) contours += analysis.event(child).contours;
        if (own[i] == 0) check.fail(event_name(id) + " has no level");
        if (contours != event.contours) check.fail("the levels of " + event_name(id) + " do not explain its number of contours");
        if (!flat && change[i] != 2 * event.delta_chi)
            check.fail("the levels of " + event_name(id) + " do not explain its change of Euler number");
    }
    return check.result(std::to_string(levels) + " levels in " + std::to_string(events) + " events");
}

}  // namespace isoatlas
