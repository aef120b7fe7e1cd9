// What an OpenVDB file holds, read here: OpenVDB trusts every count and size in its files, takes memory for them, and leaves a tree that it
// could not read whole behind. So it gets one grid, after every number that decides where the next one lies was checked.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/volume/vdb_cursor.h"

namespace isoatlas {

/// One grid: [begin, body) names it, [body, end) has its metadata, transform and tree.
struct VdbGridPlace {
    std::string id{};      ///< unique in the file
    std::string name{};    ///< may be empty
    std::string type{};    ///< of its values: "float", "vec3s", ...; of an unusual tree: that of the tree
    std::string parent{};  ///< the id of the grid whose tree it has, "": its own
    bool is_half = false;
    std::int64_t begin = 0, body = 0, end = 0;
};

struct VdbFile {
    std::string path{};
    std::uint32_t version = 0;
    std::uint32_t compression = 0;  ///< of all grids, before version 222
    std::int64_t header_bytes = 0;
    std::vector<VdbGridPlace> grids{};
};

/// Bytes of the file, or others.
struct VdbPiece {
    std::string own{};
    std::int64_t begin = 0, end = 0;
};

/// The grids of a file. One whose values are not numbers, vectors or bool ends where the file says.
/// Throws Error: input, unsupported (another version; a grid whose end is unknown).
[[nodiscard]] VdbFile read_vdb_file(const std::string& path);

/// A file with the one grid, or with the one whose tree it has before it; checked from its first byte to its last. It has no metadata but
/// the class of the grid, the unit and whether halves are stored.
/// Throws Error: input, unsupported (a frustum; values of a type that is not checked).
/// Cost: reads and decompresses the grid, a node at a time; memory: 12 bytes for each leaf (8^3 voxels) of a grid of bool.
[[nodiscard]] std::vector<VdbPiece> checked_vdb_grid(const VdbFile& file, const VdbGridPlace& grid);

/// How a tree is stored.
struct VdbTreeForm {
    std::string type{};  ///< of its values
    std::uint32_t version = 0, compression = 0;
    bool is_half = false;
    bool is_wanted = false;  ///< compressed values are checked too: OpenVDB leaves a tree behind where it cannot decompress them
};

/// Whether check_vdb_tree() knows values of the type.
[[nodiscard]] bool is_known_vdb_type(const std::string& type);
/// Reads a tree of a known type and its samples, up to the byte behind them.
void check_vdb_tree(VdbCursor& cursor, const VdbTreeForm& form);

}  // namespace isoatlas
