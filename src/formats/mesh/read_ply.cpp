// PLY of any kind: ascii and both binary forms, scalar types by all their names, polygons. Source: G. Turk, "The PLY Polygon File Format".
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "formats/common/byte_cursor.h"
#include "formats/mesh/mesh_formats.h"

namespace isoatlas {

namespace {

enum class Scalar : std::uint8_t { i8, u8, i16, u16, i32, u32, f32, f64 };
enum class Encoding : std::uint8_t { ascii, little, big };

struct Property {
    std::string_view name;
    Scalar type;
    std::optional<Scalar> count_type;  ///< set: a list
};

struct PlyElement {
    std::string_view name;
    std::uint64_t count;
    std::vector<Property> properties;
};

struct Header {
    Encoding encoding;
    std::vector<PlyElement> elements;
};

std::size_t bytes_of_scalar(Scalar type) {
    constexpr std::array<std::size_t, 8> kBytes{1, 1, 2, 2, 4, 4, 4, 8};
    return kBytes[static_cast<std::size_t>(type)];
}

Scalar scalar_named(std::string_view name, const ByteCursor& in) {
    constexpr std::array<std::array<const char*, 2>, 8> kNames{{{"char", "int8"},
                                                                {"uchar", "uint8"},
                                                                {"short", "int16"},
                                                                {"ushort", "uint16"},
                                                                {"int", "int32"},
                                                                {"uint", "uint32"},
                                                                {"float", "float32"},
                                                                {"double", "float64"}}};
    for (std::size_t i = 0; i < kNames.size(); ++i) {
        if (name == kNames[i][0] || name == kNames[i][1]) return static_cast<Scalar>(i);
    }
    in.fail_at_line("unknown PLY type " + in_quotes(name), "char, uchar, short, ushort, int, uint, float or double");
}

Encoding encoding_named(std::string_view name, const ByteCursor& in) {
    if (name == "ascii") return Encoding::ascii;
    if (name == "binary_little_endian") return Encoding::little;
    if (name == "binary_big_endian") return Encoding::big;
    in.fail_at_line("unknown PLY format " + in_quotes(name), "ascii, binary_little_endian or binary_big_endian");
}

Property parse_property(std::string_view line, const ByteCursor& in) {
    std::string_view type = take_word(line);
    std::optional<Scalar> count_type;
    if (type == "list") {
        count_type = scalar_named(take_word(line), in);
        if (*count_type == Scalar::f32 || *count_type == Scalar::f64) in.fail_at_line("a list is counted with a floating-point number");
        type = take_word(line);
    }
    const Scalar scalar = scalar_named(type, in);
    const std::string_view name = take_word(line);
    if (name.empty()) in.fail_at_line("a property without a name");
    return {name, scalar, count_type};
}

Header parse_header(ByteCursor& in, Mesh& mesh) {
    if (in.line() != "ply") in.fail_at_line("not a PLY file: it does not start with \"ply\"");
    Header header{};
    bool has_format = false;
    for (;;) {
        if (in.left() == 0) in.fail_at_line("the PLY header has no end_header");
        std::string_view line = in.line();
        const std::string_view keyword = take_word(line);
        if (keyword == "end_header") break;
        if (keyword == "comment") take_comment(mesh, line);
        if (keyword == "comment" || keyword == "obj_info" || keyword.empty()) continue;
        if (keyword == "format") {
            header.encoding = encoding_named(take_word(line), in);
            has_format = true;
        } else if (keyword == "element") {
            PlyElement element{take_word(line), 0, {}};
            const std::string_view count = take_word(line);
            if (!parse_number(count, element.count)) in.fail_at_line("the element count " + in_quotes(count) + " is not a number");
            header.elements.push_back(std::move(element));
        } else if (keyword == "property" && !header.elements.empty()) {
            header.elements.back().properties.push_back(parse_property(line, in));
        } else {
            in.fail_at_line("unexpected " + in_quotes(keyword) + " in the PLY header");
        }
    }
    if (!has_format) in.fail_at_line("the PLY header has no format line");
    return header;
}

/// Rejects headers with more rows than the file has bytes for.
void check_count(const PlyElement& element, Encoding encoding, const ByteCursor& in) {
    std::uint64_t row = 0;
    for (const Property& p : element.properties) row += encoding == Encoding::ascii ? 1 : bytes_of_scalar(p.count_type.value_or(p.type));
    if (row > 0 && element.count > in.left() / row) {
        in.fail_at_offset("the header promises " + std::to_string(element.count) + " of element " + in_quotes(element.name) + ", but " +
                              std::to_string(in.left()) + " bytes are left",
                          "at least " + std::to_string(row) + " bytes each");
    }
}

double read_ascii(ByteCursor& in) {
    double value;
    const std::string_view word = in.word();
    if (word.empty()) in.fail_at_line("the file ends before its last element");
    if (!parse_number(word, value)) in.fail_at_line(in_quotes(word) + " is not a number");
    return value;
}

/// Every scalar type is exact in a double.
double read_scalar(ByteCursor& in, Scalar type, Encoding encoding) {
    if (encoding == Encoding::ascii) return read_ascii(in);
    const bool big = encoding == Encoding::big;
    switch (type) {
        case Scalar::i8: return in.number<std::int8_t>(big, "an element");
        case Scalar::u8: return in.number<std::uint8_t>(big, "an element");
        case Scalar::i16: return in.number<std::int16_t>(big, "an element");
        case Scalar::u16: return in.number<std::uint16_t>(big, "an element");
        case Scalar::i32: return in.number<std::int32_t>(big, "an element");
        case Scalar::u32: return in.number<std::uint32_t>(big, "an element");
        case Scalar::f32: return static_cast<double>(in.number<float>(big, "an element"));
        case Scalar::f64: break;
    }
    return in.number<double>(big, "an element");
}

bool is_whole(double value) { return std::abs(value) <= 0x1p53 && value == std::floor(value); }

std::size_t read_list_count(ByteCursor& in, const Property& property, Encoding encoding) {
    const double count = read_scalar(in, *property.count_type, encoding);
    const std::size_t bytes = encoding == Encoding::ascii ? 1 : bytes_of_scalar(property.type);
    const std::size_t max = in.left() / bytes;
    if (!is_whole(count) || count < 0 || static_cast<std::size_t>(count) > max) {
        in.fail_at_offset("a list claims more items than the file holds");
    }
    return static_cast<std::size_t>(count);
}

void skip_element(ByteCursor& in, const PlyElement& element, Encoding encoding) {
    if (element.properties.empty()) return;
    for (std::uint64_t row = 0; row < element.count; ++row) {
        for (const Property& p : element.properties) {
            std::size_t items = p.count_type ? read_list_count(in, p, encoding) : 1;
            for (; items > 0; --items) (void)read_scalar(in, p.type, encoding);
        }
    }
}

/// Destination of a vertex property.
enum class Role : std::uint8_t { x, y, z, object, contour, none };

Role role_of(const Property& property) {
    constexpr std::array<const char*, 5> kNames{"x", "y", "z", "object", "contour"};
    for (std::size_t i = 0; i < kNames.size(); ++i) {
        if (property.name == kNames[i] && !property.count_type) return static_cast<Role>(i);
    }
    return Role::none;
}

class VertexReader {
public:
    VertexReader(const PlyElement& element, Encoding encoding, Mesh& mesh) : element_(element), encoding_(encoding), mesh_(mesh) {
        for (const Property& p : element.properties) {
            roles_.push_back(role_of(p));
            has_[static_cast<std::size_t>(roles_.back())] = true;
        }
    }
    void read(ByteCursor& in) {
        if (element_.count == 0) return;
        if (!has_[0] || !has_[1] || !has_[2]) in.fail_at_offset("the vertices have no x, y and z");
        const auto count = static_cast<std::size_t>(element_.count);
        mesh_.points.reserve(count);
        if (has_[3]) mesh_.object.reserve(count);
        if (has_[4]) mesh_.contour.reserve(count);
        for (std::size_t row = 0; row < count; ++row) read_row(in);
        if (!ids_are_whole_[0]) mesh_.object.clear();  // a property of another program with this name
        if (!ids_are_whole_[1]) mesh_.contour.clear();
    }

private:
    void read_row(ByteCursor& in) {
        std::array<double, 6> value{};
        for (std::size_t i = 0; i < roles_.size(); ++i) {
            const Property& p = element_.properties[i];
            std::size_t items = p.count_type ? read_list_count(in, p, encoding_) : 1;
            for (; items > 0; --items) value[static_cast<std::size_t>(roles_[i])] = read_scalar(in, p.type, encoding_);
        }
        mesh_.points.push_back({value[0], value[1], value[2]});
        if (has_[3]) add_id(mesh_.object, value[3], ids_are_whole_[0]);
        if (has_[4]) add_id(mesh_.contour, value[4], ids_are_whole_[1]);
    }
    static void add_id(Array<std::int64_t>& ids, double value, bool& whole) {
        whole = whole && is_whole(value);
        if (whole) ids.push_back(static_cast<std::int64_t>(value));
    }

    const PlyElement& element_;
    Encoding encoding_;
    Mesh& mesh_;
    std::vector<Role> roles_;
    std::array<bool, 6> has_{};
    std::array<bool, 2> ids_are_whole_{true, true};
};

void read_faces(ByteCursor& in, const PlyElement& element, Encoding encoding, Mesh& mesh) {
    const auto is_corners = [](const Property& p) { return p.count_type && (p.name == "vertex_indices" || p.name == "vertex_index"); };
    if (element.count > 0 && std::none_of(element.properties.begin(), element.properties.end(), is_corners)) {
        in.fail_at_offset("the faces have no list vertex_indices");
    }
    std::vector<std::int64_t> corners;
    for (std::uint64_t row = 0; row < element.count; ++row) {
        for (const Property& p : element.properties) {
            std::size_t items = p.count_type ? read_list_count(in, p, encoding) : 1;
            if (is_corners(p)) corners.clear();
            for (; items > 0; --items) {
                const double value = read_scalar(in, p.type, encoding);
                if (!is_corners(p)) continue;
                if (!is_whole(value)) in.fail_at_offset("a point number is not a whole number");
                corners.push_back(static_cast<std::int64_t>(value));
            }
        }
        add_polygon(mesh, corners);
    }
}

}  // namespace

Mesh parse_ply(std::string_view bytes, const std::string& file) {
    ByteCursor in(bytes, file);
    Mesh mesh;
    const Header header = parse_header(in, mesh);
    bool has_vertices = false;
    for (const PlyElement& element : header.elements) {
        check_count(element, header.encoding, in);
        if (element.name == "vertex" && !has_vertices) {
            VertexReader(element, header.encoding, mesh).read(in);
            has_vertices = true;
        } else if (element.name == "face") {
            read_faces(in, element, header.encoding, mesh);
        } else if (element.name == "tristrips" && element.count > 0) {
            throw Error(ErrorKind::unsupported, {.file = file,
                                                 .what = "the triangles are stored as strips",
                                                 .next = "convert the file to a PLY with faces, e.g. with meshlabserver or assimp"});
        } else {
            skip_element(in, element, header.encoding);
        }
    }
    if (!has_vertices) in.fail_at_offset("the PLY file has no vertices");
    check_mesh(mesh, file);
    return mesh;
}

}  // namespace isoatlas
