// GraphML (networkx, Gephi, yEd): a directed graph with typed data at its nodes and edges.
#pragma once

#include <array>
#include <cmath>
#include <span>
#include <string_view>

#include "formats/common/byte_writer.h"
#include "formats/common/connectivity.h"

namespace isoatlas {

struct GraphmlKey {
    const char* name;
    const char* type;   ///< "double", "long", "string"
    const char* owner;  ///< "node", "edge", "graph"
};

/// Everything before the first node: keys, the graph with its name, the connectivity of its volume.
void begin_graphml(ByteWriter& out, std::span<const GraphmlKey> keys, const char* graph, const char* schema,
                   const Connectivity& connectivity);
/// Ends the file.
void end_graphml(ByteWriter& out);

// Data of the node or edge that is open. The text is fixed and needs no escaping.
void put_text(ByteWriter& out, const char* key, std::string_view text);
void put(ByteWriter& out, const char* key, std::int64_t number);
/// Infinite numbers are omitted.
void put(ByteWriter& out, const char* key, double number);
/// As x, y, z.
void put(ByteWriter& out, const std::array<double, 3>& position);

/// Opens the node "n7"; the caller closes it.
void begin_node(ByteWriter& out, std::int64_t id);
/// Opens the edge between two nodes; the caller closes it.
void begin_edge(ByteWriter& out, std::int64_t from, std::int64_t to);

}  // namespace isoatlas
