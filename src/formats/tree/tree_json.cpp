// The tree as JSON, streamed: docs/schema/tree-*.schema.json.
#include <cmath>

#include "formats/common/generator.h"
#include "formats/tree/tree_formats.h"
#include "formats/volume/volume_json.h"

namespace isoatlas {

namespace {

void put_count_or_null(JsonStream& json, const char* key, std::int64_t count, bool known) {
    json.key(key);
    known ? json.value(count) : json.null();
}

void put_counts(JsonStream& json, const Analysis& analysis) {
    json.line().key("counts").begin_object().key("voxels").value(analysis.extent().voxels());
    json.key("events").value(analysis.event_count()).key("levels").value(analysis.level_count());
    json.key("elements").value(analysis.element_count()).key("contours").value(analysis.contour_arc_count()).end_object();
}

/// One number for each contour, or one pair for each genus when there are too many contours to list.
void put_genera(JsonStream& json, std::span<const GenusCount> genera, bool listed) {
    json.key(listed ? "contours" : "genus_counts").begin_array();
    for (const GenusCount& g : genera) {
        if (!listed) json.begin_array().value(g.genus).value(g.count).end_array();
        for (std::int64_t i = 0; i < g.count && listed; ++i) json.value(g.genus);
    }
    json.end_array();
}

void put_event(JsonStream& json, const TreeView& tree, const Event& event, std::span<const GenusCount> genera, bool listed) {
    json.line().begin_object().key("id").value(event.id.number()).key("value").value(tree.reported(event.value));
    json.key("position").value(event.position).key("kind").value(isoatlas::name_of(event.kind));
    put_count_or_null(json, "parent", event.parent.number(), event.parent.exists());
    json.key("children").begin_array();
    for (const EventId child : event.children) json.value(child.number());
    json.end_array().key("objects_in").value(event.objects_in).key("lows_out").value(event.lows_out);
    json.key("delta_chi").value(event.delta_chi).key("zone").begin_object();
    json.key("tau_low").value(tree.reported(event.zone.tau_low)).key("tau_high").value(tree.reported(event.zone.tau_high));
    put_count_or_null(json, "voxels", event.zone.voxels, tree.has_zones);
    json.end_object().key("object").begin_object().key("chi").value(event.chi).key("b1").value(event.b1).key("b2").value(event.b2);
    put_count_or_null(json, "voxels", event.object_voxels, tree.has_zones);
    put_genera(json, genera, listed);
    json.end_object().end_object();
}

bool contours_fit(const TreeView& tree) {
    std::int64_t total = 0;
    for (const EventId id : ids<EventId>(tree.analysis.event_count())) {
        total += tree.analysis.event(id).contours;
        if (total > tree.options.max_listed_contours) return false;
    }
    return true;
}

void put_events(JsonStream& json, const TreeView& tree) {
    const bool listed = contours_fit(tree);
    json.line().key("contours_listed").value(listed).line().key("events").begin_array();
    visit_events(tree, [&](const Event& event, std::span<const GenusCount> genera) { put_event(json, tree, event, genera, listed); });
}

void put_list(JsonStream& json, const char* key, const std::vector<std::int64_t>& numbers) {
    json.key(key).begin_array();
    for (const std::int64_t number : numbers) json.value(number);
    json.end_array();
}

void put_levels(JsonStream& json, const TreeView& tree) {
    json.line().key("levels").begin_array();
    for (std::int64_t id = 0; id < tree.analysis.level_count(); ++id) {
        const Level level = tree.analysis.level(id);
        json.line().begin_object().key("value").value(tree.reported(level.value)).key("event").value(level.event.number());
        put_list(json, "in", level.in);
        put_list(json, "out", level.out);
        json.end_object();
    }
}

void put_elements(JsonStream& json, const TreeView& tree) {
    json.line().key("elements").begin_array();
    for (const ElementId id : ids<ElementId>(tree.analysis.element_count())) {
        const Element element = tree.analysis.element(id);
        json.line().begin_object().key("value").value(tree.reported(element.value)).key("position").value(element.position);
        json.key("h0").value(element.h0).key("l0").value(element.l0).end_object();
    }
}

void put_contours(JsonStream& json, const TreeView& tree) {
    json.line().key("contours").begin_array();
    for (std::int64_t id = 0; id < tree.analysis.contour_arc_count(); ++id) {
        const ContourArc arc = tree.analysis.contour_arc(id);
        json.line().begin_object().key("id").value(id).key("upper").value(arc.upper.number());
        put_count_or_null(json, "lower", arc.lower.number(), !tree.is_outside(arc.lower));
        json.key("tau_high").value(tree.reported(arc.value_high)).key("tau_low").value(tree.reported(arc.value_low));
        json.key("genus").value(arc.genus).end_object();
    }
}

}  // namespace

void write_json(const TreeView& tree, const JsonStream::Output& output) {
    JsonStream json(output);
    json.begin_object().line().key("schema").value("isoatlas/tree/1").key("version").value(kVersion);
    put_members(json.line(), tree.connectivity());
    json.key("boundary").value("closed");
    put_volume(json, tree.volume.info);
    put_counts(json, tree.analysis);
    json.line().key("detail").value(name_of(tree.options.detail));
    switch (tree.options.detail) {
        case TreeDetail::events: put_events(json, tree); break;
        case TreeDetail::levels: put_levels(json, tree); break;
        case TreeDetail::elements: put_elements(json, tree); break;
        case TreeDetail::contours: put_contours(json, tree); break;
    }
    json.line().end_array().line().end_object().finish();
}

}  // namespace isoatlas
