// The tree as GraphML (networkx, Gephi, yEd): events with edges to their parents, or critical elements with the contours between them.
#include <array>

#include "formats/tree/graphml.h"
#include "formats/tree/tree_formats.h"

namespace isoatlas {

namespace {

constexpr std::array kEventKeys{
    GraphmlKey{"value", "double", "node"},    GraphmlKey{"x", "double", "node"},       GraphmlKey{"y", "double", "node"},
    GraphmlKey{"z", "double", "node"},        GraphmlKey{"kind", "string", "node"},    GraphmlKey{"objects_in", "long", "node"},
    GraphmlKey{"lows_out", "long", "node"},   GraphmlKey{"delta_chi", "long", "node"}, GraphmlKey{"tau_low", "double", "node"},
    GraphmlKey{"tau_high", "double", "node"}, GraphmlKey{"voxels", "long", "node"},    GraphmlKey{"chi", "long", "node"},
    GraphmlKey{"b1", "long", "node"},         GraphmlKey{"b2", "long", "node"},        GraphmlKey{"object_voxels", "long", "node"},
    GraphmlKey{"contours", "long", "node"},   GraphmlKey{"genera", "string", "node"}};
constexpr std::array kContourKeys{GraphmlKey{"value", "double", "node"},   GraphmlKey{"x", "double", "node"},
                                  GraphmlKey{"y", "double", "node"},       GraphmlKey{"z", "double", "node"},
                                  GraphmlKey{"h0", "long", "node"},        GraphmlKey{"l0", "long", "node"},
                                  GraphmlKey{"id", "long", "edge"},        GraphmlKey{"tau_high", "double", "edge"},
                                  GraphmlKey{"tau_low", "double", "edge"}, GraphmlKey{"genus", "long", "edge"}};

void put_event_nodes(ByteWriter& out, const TreeView& tree) {
    visit_events(tree, [&](const Event& e, std::span<const GenusCount> genera) {
        begin_node(out, e.id.number());
        put(out, "value", tree.reported(e.value));
        put(out, e.position);
        put_text(out, "kind", isoatlas::name_of(tree.kind_of(e)));
        put(out, "objects_in", e.objects_in);
        put(out, "lows_out", e.lows_out);
        put(out, "delta_chi", e.delta_chi);
        const auto [low, high] = tree.reported(e.zone);
        put(out, "tau_low", low);
        put(out, "tau_high", high);
        put(out, "chi", e.chi);
        put(out, "b1", e.b1);
        put(out, "b2", e.b2);
        if (tree.has_zones) {
            put(out, "voxels", e.zone.voxels);
            put(out, "object_voxels", e.object_voxels);
        }
        put(out, "contours", e.contours);
        put_text(out, "genera", histogram_text(genera));
        out.text("</node>\n");
    });
    for (const EventId id : ids<EventId>(tree.analysis.event_count())) {
        const EventId parent = tree.analysis.event(id).parent;
        if (!parent.exists()) continue;
        begin_edge(out, id.number(), parent.number());
        out.text("</edge>\n");
    }
}

/// The node after the last element is the outside of the volume.
void put_contour_nodes(ByteWriter& out, const TreeView& tree) {
    for (const ElementId id : ids<ElementId>(tree.analysis.element_count())) {
        const Element e = tree.analysis.element(id);
        begin_node(out, id.number());
        put(out, "value", tree.reported(e.value));
        put(out, e.position);
        put(out, "h0", std::int64_t{e.h0});
        put(out, "l0", std::int64_t{e.l0});
        out.text("</node>\n");
    }
    begin_node(out, tree.analysis.element_count());
    out.text("</node>\n");
    for (std::int64_t id = 0; id < tree.analysis.contour_arc_count(); ++id) {
        const ContourArc arc = tree.analysis.contour_arc(id);
        begin_edge(out, arc.upper.number(), arc.lower.number());
        put(out, "id", id);
        const auto [low, high] = tree.reported(arc);
        put(out, "tau_high", high);
        put(out, "tau_low", low);
        put(out, "genus", arc.genus);
        out.text("</edge>\n");
    }
}

}  // namespace

void write_tree_graphml(Sink& sink, const TreeView& tree) {
    const bool events = tree.options.detail == TreeDetail::events;
    ByteWriter out(sink);
    const std::span<const GraphmlKey> keys = events ? std::span<const GraphmlKey>(kEventKeys) : kContourKeys;
    begin_graphml(out, keys, events ? "criticality_tree" : "contour_tree", "isoatlas/tree/1", tree.connectivity());
    events ? put_event_nodes(out, tree) : put_contour_nodes(out, tree);
    end_graphml(out);
}

}  // namespace isoatlas
