#include "formats/tree/graphml.h"

#include "formats/common/generator.h"

namespace isoatlas {
namespace {

constexpr std::array kGraphKeys{GraphmlKey{"schema", "string", "graph"}, GraphmlKey{"generator", "string", "graph"},
                                GraphmlKey{"interpolant", "string", "graph"}, GraphmlKey{"tunnel_height", "double", "graph"},
                                GraphmlKey{"boundary", "string", "graph"}};
constexpr std::array kLowKeys{GraphmlKey{"polarity", "string", "graph"}};

void put_keys(ByteWriter& out, std::span<const GraphmlKey> keys) {
    for (const GraphmlKey& key : keys) {
        out.text(std::string("<key id=\"") + key.name + "\" for=\"" + key.owner + "\" attr.name=\"" + key.name + "\" attr.type=\"" +
                 key.type + "\"/>\n");
    }
}

template <class T>
void put_number(ByteWriter& out, const char* key, T number) {
    out.text("<data key=\"");
    out.text(key);
    out.text("\">");
    out.number(number);
    out.text("</data>");
}

}  // namespace

void begin_graphml(ByteWriter& out, std::span<const GraphmlKey> keys, const char* graph, const char* schema,
                   const Connectivity& connectivity) {
    out.text("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<graphml xmlns=\"http://graphml.graphdrawing.org/xmlns\">\n");
    put_keys(out, kGraphKeys);
    if (connectivity.is_low()) put_keys(out, kLowKeys);
    put_keys(out, keys);
    out.text(std::string("<graph id=\"") + graph + "\" edgedefault=\"directed\">\n");
    put_text(out, "schema", schema);
    put_text(out, "generator", kGenerator);
    put_text(out, "interpolant", connectivity.name());
    if (connectivity.has_tunnels()) put(out, "tunnel_height", connectivity.tunnel_height);
    if (connectivity.is_low()) put_text(out, "polarity", name_of(connectivity.polarity));
    put_text(out, "boundary", "closed");
    out.text("\n");
}

void end_graphml(ByteWriter& out) {
    out.text("</graph>\n</graphml>\n");
    out.finish();
}

void put_text(ByteWriter& out, const char* key, std::string_view text) {
    out.text("<data key=\"");
    out.text(key);
    out.text("\">");
    out.text(text);
    out.text("</data>");
}
void put(ByteWriter& out, const char* key, std::int64_t number) { put_number(out, key, number); }
void put(ByteWriter& out, const char* key, double number) {
    if (std::isfinite(number)) put_number(out, key, number);
}
void put(ByteWriter& out, const std::array<double, 3>& position) {
    put(out, "x", position[0]);
    put(out, "y", position[1]);
    put(out, "z", position[2]);
}
void begin_node(ByteWriter& out, std::int64_t id) {
    out.text("<node id=\"n");
    out.number(id);
    out.text("\">");
}
void begin_edge(ByteWriter& out, std::int64_t from, std::int64_t to) {
    out.text("<edge source=\"n");
    out.number(from);
    out.text("\" target=\"n");
    out.number(to);
    out.text("\">");
}

}  // namespace isoatlas
