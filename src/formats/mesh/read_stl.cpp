// STL, binary and text. Triangles do not share points: bit-equal points are welded.
#include <array>
#include <cmath>

#include "formats/common/byte_cursor.h"
#include "formats/mesh/mesh_formats.h"
#include "formats/mesh/point_table.h"

namespace isoatlas {

namespace {

constexpr std::size_t kHeaderBytes = 84, kTriangleBytes = 50;

bool starts_with_solid(std::string_view bytes) { return ByteCursor(bytes, std::string()).word() == "solid"; }

/// Binary files may start with "solid" too: a file is binary when its size matches the count.
bool is_binary(std::string_view bytes, const std::string& file) {
    if (bytes.size() < kHeaderBytes) return !starts_with_solid(bytes);
    ByteCursor in(bytes, file);
    in.go_to(80);
    const auto count = in.number<std::uint32_t>(false, "the triangle count");
    return bytes.size() == kHeaderBytes + kTriangleBytes * std::uint64_t{count} || !starts_with_solid(bytes);
}

/// "SPACE=LPS" of 3D Slicer; of our own headers "space" and "unit" with the word behind them.
void take_header(Mesh& mesh, std::string_view text) {
    take_comment(mesh, text);
    const std::vector<std::string_view> words = split_words(text);
    if (words.empty() || words[0] != "isoatlas") return;
    for (std::size_t i = 1; i + 1 < words.size(); ++i) {
        if (words[i] == "space" || words[i] == "unit") take_comment(mesh, std::string(words[i]) + " " + std::string(words[i + 1]));
    }
}

std::int64_t numbered(PointTable& table, const std::array<double, 3>& point, const std::string& file, std::size_t triangle) {
    if (!std::isfinite(point[0]) || !std::isfinite(point[1]) || !std::isfinite(point[2])) {
        throw Error(ErrorKind::input, {.file = file,
                                       .where = "triangle " + std::to_string(triangle),
                                       .what = "a coordinate is not a finite number",
                                       .next = "repair the mesh with the program that made it"});
    }
    return table.number(point);
}

Mesh parse_binary(std::string_view bytes, const std::string& file) {
    ByteCursor in(bytes, file);
    const std::string_view header = in.bytes(80, "the STL header");
    const std::uint64_t count = in.number<std::uint32_t>(false, "the triangle count");
    if (in.left() != count * kTriangleBytes) {
        in.fail_at_offset("the file promises " + std::to_string(count) + " triangles, but " + std::to_string(in.left()) + " bytes follow",
                          std::to_string(count * kTriangleBytes) + " bytes");
    }
    Mesh mesh;
    take_header(mesh, header.substr(0, header.find('\0')));
    mesh.triangles.reserve(count);
    PointTable table;
    for (std::size_t t = 0; t < count; ++t) {
        (void)in.bytes(12, "a normal");
        std::array<std::int64_t, 3> triangle{};
        for (std::int64_t& corner : triangle) {
            std::array<double, 3> point{};
            for (double& x : point) x = static_cast<double>(in.number<float>(false, "a triangle"));
            corner = numbered(table, point, file, t);
        }
        (void)in.bytes(2, "a triangle");
        mesh.triangles.push_back(triangle);
    }
    mesh.points = table.take_points();
    return mesh;
}

void expect(ByteCursor& in, std::string_view keyword) {
    const std::string_view word = in.word();
    if (word != keyword) {
        in.fail_at_line(word.empty() ? "the file ends inside a solid" : "unexpected " + in_quotes(word),
                        "\"" + std::string(keyword) + "\"");
    }
}

double coordinate(ByteCursor& in) {
    double value;
    const std::string_view word = in.word();
    if (!parse_number(word, value)) in.fail_at_line(in_quotes(word) + " is not a number");
    return value;
}

void parse_facet(ByteCursor& in, Mesh& mesh, PointTable& table) {
    expect(in, "normal");
    for (int i = 0; i < 3; ++i) (void)in.word();  // some programs write words such as nan; the normal is not used
    expect(in, "outer");
    expect(in, "loop");
    std::array<std::int64_t, 3> triangle{};
    for (std::int64_t& corner : triangle) {
        expect(in, "vertex");
        const double x = coordinate(in), y = coordinate(in), z = coordinate(in);
        corner = numbered(table, {x, y, z}, in.file(), mesh.triangles.size());
    }
    expect(in, "endloop");
    expect(in, "endfacet");
    mesh.triangles.push_back(triangle);
}

Mesh parse_text(std::string_view bytes, const std::string& file) {
    ByteCursor in(bytes, file);
    Mesh mesh;
    PointTable table;
    for (std::string_view word = in.word(); !word.empty(); word = in.word()) {  // a file may hold several solids
        if (word != "solid") in.fail_at_line("unexpected " + in_quotes(word), "\"solid\"");
        take_comment(mesh, in.line());  // its name
        for (word = in.word(); word == "facet"; word = in.word()) parse_facet(in, mesh, table);
        if (word != "endsolid") {
            in.fail_at_line(word.empty() ? "the file ends inside a solid" : "unexpected " + in_quotes(word), "\"facet\" or \"endsolid\"");
        }
        (void)in.line();
    }
    mesh.points = table.take_points();
    return mesh;
}

}  // namespace

Mesh parse_stl(std::string_view bytes, const std::string& file) {
    Mesh mesh = is_binary(bytes, file) ? parse_binary(bytes, file) : parse_text(bytes, file);
    check_mesh(mesh, file);
    return mesh;
}

}  // namespace isoatlas
