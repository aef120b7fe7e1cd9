// Header, metadata and transforms of OpenVDB files.
#include "formats/volume/vdb_file.h"

#include <array>
#include <optional>
#include <utility>

#include "isoatlas/text.h"

namespace isoatlas {
namespace {

constexpr std::uint32_t kOldestVdb = 221, kVdbOfGrids = 222, kNewestVdb = 224;
constexpr std::string_view kHalfSuffix = "_HalfFloat", kTreePrefix = "Tree_", kTreeLevels = "_5_4_3";

[[noreturn]] void unsupported_vdb(const std::string& path, const std::string& what, const std::string& expected, const std::string& next) {
    throw Error(ErrorKind::unsupported, {.file = path, .what = what, .expected = expected, .next = next});
}

/// The few entries of the metadata of a grid that are used.
struct VdbMetadata {
    std::optional<std::string> grid_class, unit;
    bool is_half = false;
};

VdbMetadata read_vdb_metadata(VdbCursor& cursor) {
    VdbMetadata found;
    const auto count = cursor.number<std::uint32_t>();
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::string name = cursor.text(), type = cursor.text();
        const auto bytes = cursor.number<std::uint32_t>();
        constexpr std::uint32_t kMaxUsed = 4096;
        if (type == "string" && bytes <= kMaxUsed && (name == "class" || name == "unit")) {
            const std::span<const std::byte> value = cursor.bytes(bytes);
            (name == "class" ? found.grid_class : found.unit) = std::string(reinterpret_cast<const char*>(value.data()), value.size());
        } else if (name == "is_saved_as_half_float") {
            if (type != "bool" || bytes != 1) cursor.refuse("its field 'is_saved_as_half_float' is no bool");
            found.is_half = cursor.number<std::uint8_t>() != 0;
        } else {
            cursor.skip(bytes);
        }
    }
    return found;
}

void put_vdb_number(std::string& out, std::uint32_t number) { out.append(reinterpret_cast<const char*>(&number), sizeof number); }
void put_vdb_text(std::string& out, std::string_view text) {
    put_vdb_number(out, static_cast<std::uint32_t>(text.size()));
    out += text;
}

std::string written_vdb_metadata(const VdbMetadata& metadata) {
    std::string out;
    put_vdb_number(out, 1U + (metadata.grid_class ? 1U : 0U) + (metadata.unit ? 1U : 0U));
    for (const auto& [name, value] : {std::pair("class", metadata.grid_class), std::pair("unit", metadata.unit)}) {
        if (!value) continue;
        put_vdb_text(out, name);
        put_vdb_text(out, "string");
        put_vdb_text(out, *value);
    }
    put_vdb_text(out, "is_saved_as_half_float");
    put_vdb_text(out, "bool");
    put_vdb_text(out, std::string_view(metadata.is_half ? "\1" : "\0", 1));
    return out;
}

/// Returns whether it is a frustum.
bool skip_vdb_transform(VdbCursor& cursor) {
    constexpr std::array<std::pair<std::string_view, int>, 7> kNumbers{{{"AffineMap", 16},
                                                                        {"UnitaryMap", 16},
                                                                        {"ScaleMap", 15},
                                                                        {"UniformScaleMap", 15},
                                                                        {"TranslationMap", 3},
                                                                        {"ScaleTranslateMap", 18},
                                                                        {"UniformScaleTranslateMap", 18}}};
    std::string name = cursor.text();
    const bool is_frustum = name == "NonlinearFrustumMap";
    if (is_frustum) {
        cursor.skip(8 * 8);    // box, taper, depth
        name = cursor.text();  // of the linear one in it
    }
    for (const auto& [known, numbers] : kNumbers) {
        if (name != known) continue;
        cursor.skip(numbers * 8);
        return is_frustum;
    }
    cursor.refuse("it has no transform of the name " + shown_name(name));
}

std::uint32_t read_vdb_compression(VdbCursor& cursor, const VdbFile& file) {
    constexpr std::uint32_t kAll = 7;
    const std::uint32_t compression = file.version < kVdbOfGrids ? file.compression : cursor.number<std::uint32_t>();
    if (compression > kAll) cursor.refuse("it has no compression of the number " + std::to_string(compression));
    return compression;
}

struct VdbBody {
    std::int64_t metadata = 0, transform = 0;  ///< where they begin
    VdbMetadata entries;
    bool is_frustum = false;
};

/// Reads a grid of a known type from its body to its end.
VdbBody read_vdb_body(VdbCursor& cursor, const VdbFile& file, const VdbGridPlace& grid, bool is_wanted) {
    VdbBody body;
    VdbTreeForm form{.type = grid.type, .version = file.version, .is_wanted = is_wanted};
    form.compression = read_vdb_compression(cursor, file);
    body.metadata = cursor.at();
    body.entries = read_vdb_metadata(cursor);
    form.is_half = body.entries.is_half;
    if (form.is_half != grid.is_half) cursor.refuse("its name and its metadata differ in whether halves are stored");
    body.transform = cursor.at();
    body.is_frustum = skip_vdb_transform(cursor);
    if (grid.parent.empty()) check_vdb_tree(cursor, form);
    return body;
}

std::string vdb_value_type(std::string type) {
    if (!type.starts_with(kTreePrefix) || !type.ends_with(kTreeLevels) || type.size() <= kTreePrefix.size() + kTreeLevels.size())
        return type;
    return type.substr(kTreePrefix.size(), type.size() - kTreePrefix.size() - kTreeLevels.size());
}

VdbGridPlace read_vdb_place(VdbCursor& cursor, const VdbFile& file, bool has_offsets) {
    VdbGridPlace grid{.begin = cursor.at()};
    grid.id = cursor.text();
    grid.name = grid.id.substr(0, grid.id.find('\x1e'));
    std::string type = cursor.text();
    grid.is_half = type.ends_with(kHalfSuffix);
    if (grid.is_half) type.resize(type.size() - kHalfSuffix.size());
    grid.type = vdb_value_type(type);
    grid.parent = cursor.text();
    cursor.skip(2 * 8);  // where the grid and where its samples begin
    const auto end = cursor.number<std::int64_t>();
    grid.body = cursor.at();
    if (has_offsets) {
        if (end < grid.body) cursor.refuse("a grid ends before it begins");
        cursor.go_to(end);
    } else if (is_known_vdb_type(grid.type)) {
        read_vdb_body(cursor, file, grid, false);
    } else {
        unsupported_vdb(file.path, "values of type " + shown_name(grid.type) + " in a file that does not say where its grids end",
                        "a file with offsets of its grids", "write it to a file, not to a stream, or without this grid");
    }
    grid.end = cursor.at();
    return grid;
}

/// Checks a grid and appends its pieces.
void add_vdb_grid(VdbCursor& cursor, const VdbFile& file, const VdbGridPlace& grid, std::vector<VdbPiece>& pieces) {
    cursor.go_to(grid.body);
    const VdbBody body = read_vdb_body(cursor, file, grid, true);
    if (cursor.at() != grid.end) cursor.refuse("the grid " + shown_name(grid.name) + " does not end where its header says");
    if (body.is_frustum) {
        unsupported_vdb(file.path, "the grid lies in a frustum, not in even steps", "a linear transform",
                        "resample it to even voxels, for example in Houdini");
    }
    pieces.push_back({.begin = grid.begin, .end = body.metadata});
    pieces.push_back({.own = written_vdb_metadata(body.entries)});
    pieces.push_back({.begin = body.transform, .end = grid.end});
}

}  // namespace

VdbFile read_vdb_file(const std::string& path) {
    constexpr std::int64_t kMagicBytes = 8, kLibraryBytes = 8, kIdentifierBytes = 36;
    VdbCursor cursor(path);
    cursor.skip(kMagicBytes);
    VdbFile file{.path = path};
    file.version = cursor.number<std::uint32_t>();
    if (file.version < kOldestVdb || file.version > kNewestVdb) {
        unsupported_vdb(path, "version " + std::to_string(file.version) + " of the format of OpenVDB",
                        "version " + std::to_string(kOldestVdb) + " to " + std::to_string(kNewestVdb),
                        "write it again with another version of OpenVDB; if that fails, the file is damaged");
    }
    cursor.skip(kLibraryBytes);
    const bool has_offsets = cursor.number<std::uint8_t>() != 0;
    if (file.version < kVdbOfGrids) file.compression = cursor.number<std::uint8_t>() != 0 ? 1 : 0;
    cursor.skip(kIdentifierBytes);
    file.header_bytes = cursor.at();
    read_vdb_metadata(cursor);
    const auto count = cursor.number<std::int32_t>();
    if (count < 1) cursor.refuse("it has no grid");
    for (std::int32_t i = 0; i < count; ++i) file.grids.push_back(read_vdb_place(cursor, file, has_offsets));
    return file;
}

std::vector<VdbPiece> checked_vdb_grid(const VdbFile& file, const VdbGridPlace& grid) {
    VdbCursor cursor(file.path);
    std::vector<VdbPiece> pieces{{.begin = 0, .end = file.header_bytes}};
    std::string counts;
    put_vdb_number(counts, 0);  // entries of the metadata of the file
    put_vdb_number(counts, grid.parent.empty() ? 1 : 2);
    pieces.push_back({.own = counts});
    if (!grid.parent.empty()) {
        const auto parent = std::ranges::find(file.grids, grid.parent, &VdbGridPlace::id);
        cursor.go_to(grid.begin);
        if (parent == file.grids.end() || !parent->parent.empty() || parent->id == grid.id || parent->type != grid.type)
            cursor.refuse("the grid " + shown_name(grid.name) + " has the tree of a grid that is not there");
        add_vdb_grid(cursor, file, *parent, pieces);
    }
    add_vdb_grid(cursor, file, grid, pieces);
    return pieces;
}

}  // namespace isoatlas
