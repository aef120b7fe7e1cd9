// write_simplified_tree: the nodes that a selection keeps, each with its zone, including bypassed zones.
#include <array>

#include "base/atomic_file.h"
#include "formats/common/csv_table.h"
#include "formats/common/file_extension.h"
#include "formats/common/generator.h"
#include "formats/tree/graphml.h"
#include "formats/tree/vtu_graph.h"
#include "formats/volume/volume_json.h"
#include "isoatlas/simplify.h"

namespace isoatlas {

namespace {

constexpr std::array kNodeKeys{GraphmlKey{"event", "long", "node"},     GraphmlKey{"object", "long", "node"},
                               GraphmlKey{"x", "double", "node"},       GraphmlKey{"y", "double", "node"},
                               GraphmlKey{"z", "double", "node"},       GraphmlKey{"kind", "string", "node"},
                               GraphmlKey{"tau_low", "double", "node"}, GraphmlKey{"tau_high", "double", "node"},
                               GraphmlKey{"voxels", "long", "node"},    GraphmlKey{"object_voxels", "long", "node"}};

/// A node in reported values.
struct NodeView {
    std::int64_t event, object, parent;  ///< as numbers
    std::array<double, 3> position;
    const char* kind;
    double tau_low, tau_high;
    std::int64_t voxels, object_voxels;
};

NodeView view_of(const SimplifiedTree& tree, std::size_t i) {
    const SimplifiedNode& node = tree.simplified.nodes[i];
    const auto [low, high] = tree.info.calibration.reported_interval(node.tau_low, node.tau_high);
    const Criticality top = polarity_of(tree.info) == Polarity::low ? Criticality::minimum : Criticality::maximum;
    return {.event = node.event.number(),
            .object = tree.hierarchy.branches()[node.branch.index()].id,
            .parent = node.parent,
            .position = tree.analysis.event(node.event).position,
            .kind = name_of(node.is_maximum ? top : Criticality::merge),
            .tau_low = low,
            .tau_high = high,
            .voxels = node.voxels,
            .object_voxels = node.object_voxels};
}

Connectivity connectivity_of(const SimplifiedTree& tree) {
    return connectivity_of(tree.info, tree.analysis.interpolant(), tree.analysis.tunnel_height());
}

void write_json(const SimplifiedTree& tree, const JsonStream::Output& output) {
    JsonStream json(output);
    json.begin_object().line().key("schema").value("isoatlas/simplified-tree/1").key("version").value(kVersion);
    put_members(json.line(), connectivity_of(tree));
    json.key("boundary").value("closed");
    put_volume(json, tree.info);
    json.line().key("objects").value(tree.hierarchy.branches().size()).key("kept").value(tree.simplified.kept.size());
    json.key("hidden").value(tree.simplified.hidden).key("hidden_voxels").value(tree.simplified.hidden_voxels);
    json.line().key("nodes").begin_array();
    for (std::size_t i = 0; i < tree.simplified.nodes.size(); ++i) {
        const NodeView node = view_of(tree, i);
        json.line().begin_object().key("event").value(node.event).key("object").value(node.object);
        json.key("position").value(node.position).key("kind").value(node.kind).key("parent");
        node.parent >= 0 ? json.value(node.parent) : json.null();
        json.key("tau_low").value(node.tau_low).key("tau_high").value(node.tau_high);
        json.key("voxels").value(node.voxels).key("object_voxels").value(node.object_voxels).end_object();
    }
    json.line().end_array().line().end_object().finish();
}

void write_csv(ByteWriter& out, const SimplifiedTree& tree) {
    const CsvTable table(out, connectivity_of(tree), "node,event,object,x,y,z,kind,parent,tau_low,tau_high,voxels,object_voxels");
    for (std::size_t i = 0; i < tree.simplified.nodes.size(); ++i) {
        const NodeView node = view_of(tree, i);
        CsvRow row = table.row();
        row.number(i).number(node.event).number(node.object).position(node.position).text(node.kind);
        row.number(node.parent, node.parent >= 0).real(node.tau_low).real(node.tau_high).number(node.voxels).number(node.object_voxels);
    }
    out.finish();
}

void write_graphml(ByteWriter& out, const SimplifiedTree& tree) {
    begin_graphml(out, kNodeKeys, "simplified_tree", "isoatlas/simplified-tree/1", connectivity_of(tree));
    for (std::size_t i = 0; i < tree.simplified.nodes.size(); ++i) {
        const NodeView node = view_of(tree, i);
        begin_node(out, static_cast<std::int64_t>(i));
        put(out, "event", node.event);
        put(out, "object", node.object);
        put(out, node.position);
        put_text(out, "kind", node.kind);
        put(out, "tau_low", node.tau_low);
        put(out, "tau_high", node.tau_high);
        put(out, "voxels", node.voxels);
        put(out, "object_voxels", node.object_voxels);
        out.text("</node>\n");
    }
    for (std::size_t i = 0; i < tree.simplified.nodes.size(); ++i) {
        const std::int64_t parent = tree.simplified.nodes[i].parent;
        if (parent < 0) continue;
        begin_edge(out, static_cast<std::int64_t>(i), parent);
        out.text("</edge>\n");
    }
    end_graphml(out);
}

/// Every line represents the zone of its upper end.
void write_vtu(Sink& sink, const SimplifiedTree& tree) {
    VtuLines lines;
    const auto nodes = static_cast<std::int64_t>(tree.simplified.nodes.size());
    const auto node_at = [&](std::int64_t i) { return view_of(tree, static_cast<std::size_t>(i)); };
    for (std::int64_t i = 0; i < nodes; ++i) {
        if (const std::int64_t parent = node_at(i).parent; parent >= 0) lines.add(i, i, parent);
    }
    const auto at = [&](std::int64_t i) {
        const bool is_maximum = tree.simplified.nodes[static_cast<std::size_t>(i)].is_maximum;
        return VtuPoint{node_at(i).position, node_at(i).tau_high, is_maximum ? TtkType::maximum : TtkType::saddle2};
    };
    VtuGraph graph(nodes, at, std::move(lines));
    graph.point_array<std::int64_t>("RegionSize", [&](std::int64_t i) { return node_at(i).voxels; });
    graph.point_array<std::int64_t>("ObjectVoxels", [&](std::int64_t i) { return node_at(i).object_voxels; });
    graph.point_array<std::int64_t>("Event", [&](std::int64_t i) { return node_at(i).event; });
    graph.point_array<std::int64_t>("Object", [&](std::int64_t i) { return node_at(i).object; });
    graph.line_array<std::int64_t>("RegionSize", [&](std::int64_t i) { return node_at(i).voxels; });
    graph.write(sink, tree.info, connectivity_of(tree));
}

std::string simplified_extension(const std::string& path) {
    return known_extension(path, {".json", ".graphml", ".csv", ".vtu"},
                           {"the format of the tree", "format of a tree", ".json, .graphml, .csv or .vtu"});
}

}  // namespace

void write_simplified_tree(Sink& sink, const SimplifiedTree& tree) {
    const std::string extension = simplified_extension(sink.name());
    if (extension == ".vtu") return write_vtu(sink, tree);
    if (extension == ".json") return write_json(tree, output_to(sink));
    ByteWriter out(sink);
    extension == ".csv" ? write_csv(out, tree) : write_graphml(out, tree);
}

void write_simplified_tree(const std::string& path, const SimplifiedTree& tree) {
    (void)simplified_extension(path);
    AtomicFile file(path);
    write_simplified_tree(file, tree);
    file.commit();
}

void write_simplified_tree_json(std::ostream& out, const SimplifiedTree& tree) { write_json(tree, output_to(out, "the simplified tree")); }

}  // namespace isoatlas
