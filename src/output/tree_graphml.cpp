// The tree as GraphML (networkx, Gephi, yEd): events with edges to their parents, or critical elements with the contours between them.
#include <array>
#include <cmath>

#include "output/byte_writer.h"
#include "output/generator.h"
#include "output/tree_formats.h"

namespace isoatlas::output {

namespace {

struct Key {
    const char* name;
    const char* type;
    const char* owner;
};

constexpr std::array kEventKeys{Key{"value", "double", "node"},    Key{"x", "double", "node"},       Key{"y", "double", "node"},
                                Key{"z", "double", "node"},        Key{"kind", "string", "node"},    Key{"objects_in", "long", "node"},
                                Key{"lows_out", "long", "node"},   Key{"delta_chi", "long", "node"}, Key{"tau_low", "double", "node"},
                                Key{"tau_high", "double", "node"}, Key{"voxels", "long", "node"},    Key{"chi", "long", "node"},
                                Key{"b1", "long", "node"},         Key{"b2", "long", "node"},        Key{"object_voxels", "long", "node"},
                                Key{"contours", "long", "node"},   Key{"genera", "string", "node"}};
constexpr std::array kContourKeys{Key{"value", "double", "node"}, Key{"x", "double", "node"},        Key{"y", "double", "node"},
                                  Key{"z", "double", "node"},     Key{"h0", "long", "node"},         Key{"l0", "long", "node"},
                                  Key{"id", "long", "edge"},      Key{"tau_high", "double", "edge"}, Key{"tau_low", "double", "edge"},
                                  Key{"genus", "long", "edge"}};
constexpr std::array kGraphKeys{Key{"schema", "string", "graph"}, Key{"generator", "string", "graph"},
                                Key{"interpolant", "string", "graph"}, Key{"tunnel_height", "double", "graph"},
                                Key{"boundary", "string", "graph"}};

template <class Keys>
void put_keys(ByteWriter& out, const Keys& keys) {
    for (const Key& key : keys) {
        out.text(std::string("<key id=\"") + key.name + "\" for=\"" + key.owner + "\" attr.name=\"" + key.name + "\" attr.type=\"" +
                 key.type + "\"/>\n");
    }
}

void put_text(ByteWriter& out, const char* key, std::string_view text) {
    out.text("<data key=\"");
    out.text(key);
    out.text("\">");
    out.text(text);
    out.text("</data>");
}
template <class T>
void put_number(ByteWriter& out, const char* key, T number) {
    out.text("<data key=\"");
    out.text(key);
    out.text("\">");
    out.number(number);
    out.text("</data>");
}
void put(ByteWriter& out, const char* key, std::int64_t number) { put_number(out, key, number); }
void put(ByteWriter& out, const char* key, double number) {
    if (std::isfinite(number)) put_number(out, key, number);
}
void put(ByteWriter& out, const std::array<double, 3>& p) {
    put(out, "x", p[0]);
    put(out, "y", p[1]);
    put(out, "z", p[2]);
}
void put_node(ByteWriter& out, std::int64_t id) {
    out.text("<node id=\"n");
    out.number(id);
    out.text("\">");
}
void put_edge(ByteWriter& out, std::int64_t from, std::int64_t to) {
    out.text("<edge source=\"n");
    out.number(from);
    out.text("\" target=\"n");
    out.number(to);
    out.text("\">");
}

void put_events(ByteWriter& out, const TreeView& tree) {
    visit_events(tree, [&](const Event& e, std::span<const GenusCount> genera) {
        put_node(out, e.id);
        put(out, "value", tree.reported(e.value));
        put(out, e.position);
        put_text(out, "kind", isoatlas::name_of(e.kind));
        put(out, "objects_in", e.objects_in);
        put(out, "lows_out", e.lows_out);
        put(out, "delta_chi", e.delta_chi);
        put(out, "tau_low", tree.reported(e.zone.tau_low));
        put(out, "tau_high", tree.reported(e.zone.tau_high));
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
    for (std::int64_t id = 0; id < tree.analysis.event_count(); ++id) {
        const std::int64_t parent = tree.analysis.event(id).parent;
        if (parent < 0) continue;
        put_edge(out, id, parent);
        out.text("</edge>\n");
    }
}

/// The node behind the last element is the outside of the volume.
void put_contours(ByteWriter& out, const TreeView& tree) {
    for (std::int64_t id = 0; id < tree.analysis.element_count(); ++id) {
        const Element e = tree.analysis.element(id);
        put_node(out, id);
        put(out, "value", tree.reported(e.value));
        put(out, e.position);
        put(out, "h0", std::int64_t{e.h0});
        put(out, "l0", std::int64_t{e.l0});
        out.text("</node>\n");
    }
    put_node(out, tree.analysis.element_count());
    out.text("</node>\n");
    for (std::int64_t id = 0; id < tree.analysis.contour_arc_count(); ++id) {
        const ContourArc arc = tree.analysis.contour_arc(id);
        put_edge(out, arc.upper, arc.lower);
        put(out, "id", id);
        put(out, "tau_high", tree.reported(arc.value_high));
        put(out, "tau_low", tree.reported(arc.value_low));
        put(out, "genus", arc.genus);
        out.text("</edge>\n");
    }
}

}  // namespace

void write_tree_graphml(AtomicFile& file, const TreeView& tree) {
    const bool events = tree.options.detail == TreeDetail::events;
    ByteWriter out(file);
    out.text("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<graphml xmlns=\"http://graphml.graphdrawing.org/xmlns\">\n");
    put_keys(out, kGraphKeys);
    events ? put_keys(out, kEventKeys) : put_keys(out, kContourKeys);
    out.text(std::string("<graph id=\"") + (events ? "criticality_tree" : "contour_tree") + "\" edgedefault=\"directed\">\n");
    put_text(out, "schema", "isoatlas/tree/1");
    put_text(out, "generator", kGenerator);
    const Connectivity connectivity = tree.connectivity();
    put_text(out, "interpolant", connectivity.name());
    if (connectivity.has_tunnels()) put(out, "tunnel_height", connectivity.tunnel_height);
    put_text(out, "boundary", "closed");
    out.text("\n");
    events ? put_events(out, tree) : put_contours(out, tree);
    out.text("</graph>\n</graphml>\n");
    out.finish();
}

}  // namespace isoatlas::output
