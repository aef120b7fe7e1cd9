// The tree as JSON, streamed: docs/schema/tree-*.schema.json.
#include <array>
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

/// Pairs of genus and number of contours.
void put_genera(JsonStream& json, std::span<const GenusCount> genera) {
    json.begin_array();
    for (const GenusCount& g : genera) json.begin_array().value(g.genus).value(g.count).end_array();
    json.end_array();
}

void put_count_or_null(JsonStream& json, std::int64_t count, bool known) { known ? json.value(count) : json.null(); }

/// A row in the order of kColumns; what follows from other rows, and the genera, only when all columns are asked for.
void put_event(JsonStream& json, const TreeView& tree, const Event& event, std::span<const GenusCount> genera) {
    json.line().begin_array().value(tree.reported(event.value));
    for (const double x : event.position) json.value(x);
    json.value(isoatlas::name_of(tree.kind_of(event)));
    put_count_or_null(json, event.parent.number(), event.parent.exists());
    json.value(event.lows_out).value(event.b1).value(event.b2);
    put_count_or_null(json, event.zone.voxels, tree.has_zones);
    put_count_or_null(json, event.object_voxels, tree.has_zones);
    if (tree.options.all) {
        json.value(event.id.number()).begin_array();
        for (const EventId child : event.children) json.value(child.number());
        json.end_array().value(tree.reported(event.zone.tau_low)).value(event.delta_chi).value(event.chi).value(event.contours);
        put_genera(json, genera);
    }
    json.end_array();
}

constexpr std::array kColumns{"value", "x", "y", "z", "kind", "parent", "lows_out", "b1", "b2", "zone_voxels", "object_voxels"};
constexpr std::array kMoreColumns{"id", "children", "tau_low", "delta_chi", "chi", "contours", "genera"};

void put_events(JsonStream& json, const TreeView& tree) {
    json.line().key("columns").begin_array();
    for (const char* name : kColumns) json.value(name);
    for (const char* name : kMoreColumns) {
        if (tree.options.all) json.value(name);
    }
    json.end_array().line().key("events").begin_array();
    if (tree.options.all) {
        visit_events(tree, [&](const Event& event, std::span<const GenusCount> genera) { put_event(json, tree, event, genera); });
        return;
    }
    for (const EventId id : ids<EventId>(tree.analysis.event_count())) put_event(json, tree, tree.analysis.event(id), {});
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
        const auto [low, high] = tree.reported(arc);
        json.key("tau_high").value(high).key("tau_low").value(low);
        json.key("genus").value(arc.genus).end_object();
    }
}

}  // namespace

void write_json(const TreeView& tree, const JsonStream::Output& output) {
    JsonStream json(output);
    json.begin_object().line().key("schema").value("isoatlas/tree/2").key("version").value(kVersion);
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
