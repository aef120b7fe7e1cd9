// Damaged files: an Error with the name of the file, or a well-formed mesh; never a crash, never memory beyond what the file can hold.
#include <gtest/gtest.h>

#include <functional>

#include "formats/mesh/mesh_formats.h"
#include "unit/formats/mesh/mesh_samples.h"

using namespace isoatlas;
using namespace mesh_samples;

namespace {

using Parser = std::function<Mesh(std::string_view, const std::string&)>;

Parser parser_of(const std::string& extension) {
    if (extension == ".ply") return parse_ply;
    if (extension == ".stl") return parse_stl;
    if (extension == ".obj") return parse_obj;
    if (extension == ".vtp") return parse_vtp;
    return parse_glb;
}

std::string file_of(const std::string& extension, const Surface& surface) {
    const Folder folder;
    write_surface(folder / ("mesh" + extension), surface);
    return read_bytes(folder / ("mesh" + extension));
}

/// True: it was refused.
bool refused(const Parser& parse, std::string_view bytes) {
    try {
        const Mesh mesh = parse(bytes, "mesh");
        const auto points = static_cast<std::int64_t>(mesh.points.size());
        for (const auto& t : mesh.triangles) {
            for (const std::int64_t p : t) EXPECT_TRUE(p >= 0 && p < points);
        }
        EXPECT_TRUE(mesh.object.empty() || mesh.object.size() == mesh.points.size());
        EXPECT_TRUE(mesh.contour.empty() || mesh.contour.size() == mesh.points.size());
        for (const Point& p : mesh.points) EXPECT_TRUE(std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]));
        return false;
    } catch (const Error& error) {
        EXPECT_TRUE(error.kind() == ErrorKind::input || error.kind() == ErrorKind::unsupported) << error.what();
        EXPECT_EQ(error.text().file, "mesh");
        EXPECT_FALSE(error.text().what.empty());
        EXPECT_FALSE(error.text().next.empty()) << error.what();
        return true;
    }
}

class Hostile : public testing::TestWithParam<const char*> {};

TEST_P(Hostile, truncated_at_every_byte) {
    Surface surface;
    add_octahedron(surface, {1, 2, 3}, 1, 7, 7);
    const std::string extension = GetParam(), bytes = file_of(extension, surface);
    const Parser parse = parser_of(extension);
    ASSERT_FALSE(refused(parse, bytes));
    // What follows the last byte of data may be missing in VTP; a text without its last faces is a shorter OBJ.
    std::size_t sure = bytes.size();
    if (extension == ".vtp") sure = bytes.rfind("\n</AppendedData>");
    if (extension == ".obj") sure = 0;
    for (std::size_t length = 0; length < bytes.size(); ++length) {
        const bool is_refused = refused(parse, std::string_view(bytes).substr(0, length));
        EXPECT_TRUE(is_refused || length >= sure) << "cut to " << length << " of " << bytes.size();
    }
}

TEST_P(Hostile, every_flipped_bit) {
    Surface surface;
    add_octahedron(surface, {1, 2, 3}, 1, 7, 7);
    std::string bytes = file_of(GetParam(), surface);
    const Parser parse = parser_of(GetParam());
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        for (int bit = 0; bit < 8; ++bit) {
            bytes[i] = static_cast<char>(bytes[i] ^ (1 << bit));
            (void)refused(parse, bytes);
            bytes[i] = static_cast<char>(bytes[i] ^ (1 << bit));
        }
    }
}

TEST_P(Hostile, the_file_of_another_format) {
    for (const char* other : {".ply", ".stl", ".obj", ".vtp", ".glb"}) {
        if (std::string(other) == GetParam()) continue;
        EXPECT_TRUE(refused(parser_of(GetParam()), file_of(other, two_objects()))) << other;
    }
    EXPECT_TRUE(refused(parser_of(GetParam()), std::string(300, '\0')));
}

INSTANTIATE_TEST_SUITE_P(Formats, Hostile, testing::Values(".ply", ".stl", ".obj", ".vtp", ".glb"),
                         [](const auto& format) { return std::string(format.param).substr(1); });

std::string ply(const std::string& body) { return "ply\nformat ascii 1.0\n" + body; }

TEST(hostile_ply, absurd_counts_are_refused_before_memory_is_taken) {
    const std::string vertex = "property float x\nproperty float y\nproperty float z\n";
    EXPECT_TRUE(refused(parse_ply, ply("element vertex 18446744073709551615\n" + vertex + "end_header\n0 0 0\n")));
    EXPECT_TRUE(refused(parse_ply, ply("element vertex 99999999999999999999\n" + vertex + "end_header\n0 0 0\n")));
    EXPECT_TRUE(refused(parse_ply, ply("element vertex -1\n" + vertex + "end_header\n")));
    EXPECT_TRUE(refused(parse_ply, ply("element vertex 1\n" + vertex +
                                       "element face 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n4000000000 0 0 0\n")));
    EXPECT_TRUE(refused(parse_ply, ply("element vertex 1\n" + vertex +
                                       "element face 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n-3 0 0 0\n")));
    EXPECT_TRUE(refused(parse_ply, ply("element vertex 1\n" + vertex +
                                       "element face 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n3 0 0 1\n")));
    EXPECT_TRUE(refused(parse_ply, ply("element vertex 1\n" + vertex + "end_header\n0 nan 0\n")));
    EXPECT_TRUE(refused(parse_ply, ply("element vertex 1\nproperty float x\nproperty float y\nend_header\n0 0\n")));
    EXPECT_FALSE(refused(parse_ply, ply("element nothing 18446744073709551615\nelement vertex 1\n" + vertex + "end_header\n0 0 0\n")));
}

TEST(hostile_ply, messages_name_the_line) {
    try {
        (void)parse_ply("ply\nformat ascii 1.0\nelement vertex 1\nproperty quux x\nend_header\n", "bad.ply");
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.text().where, "line 4");
        EXPECT_NE(error.text().what.find("quux"), std::string::npos);
    }
    try {
        (void)parse_obj("v 0 0 0\nv 1 0 zero\n", "bad.obj");
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.text().where, "line 2");
    }
}

TEST(hostile_vtp, bombs_and_contradictions) {
    const auto vtp = [](const std::string& attributes, const std::string& array) {
        return "<VTKFile type=\"PolyData\" " + attributes + "><PolyData><Piece NumberOfPoints=\"1\"><Points>" + array +
               "</Points></Piece></PolyData></VTKFile>";
    };
    for (const std::string name : {"ZLib", "LZ4"}) {
        const std::string packed = "compressor=\"vtk" + name + "DataCompressor\" header_type=\"UInt64\"";
        // 2^61 blocks; a block of 2^60 bytes; both as base64 of little-endian numbers.
        EXPECT_TRUE(
            refused(parse_vtp, vtp(packed, "<DataArray type=\"Float32\" format=\"binary\">AAAAAAAAACAAAAAAAAAAAAAAAAAAAAAA</DataArray>")));
        EXPECT_TRUE(refused(parse_vtp, vtp(packed,
                                           "<DataArray type=\"Float32\" format=\"binary\">"
                                           "AQAAAAAAAAAAAAAAAAAAEAAAAAAAAAAQBAAAAAAAAAA=AAAAAA==</DataArray>")));
    }
    EXPECT_TRUE(refused(parse_vtp, vtp("", "<DataArray type=\"Float32\" format=\"binary\">/////w==</DataArray>")));
    EXPECT_TRUE(refused(parse_vtp, vtp("", "<DataArray type=\"Float32\" format=\"appended\" offset=\"0\"/>")));
    EXPECT_TRUE(refused(parse_vtp, vtp("", "<DataArray type=\"Float32\" format=\"ascii\">1 2 3 4</DataArray>")));
    EXPECT_TRUE(refused(parse_vtp, vtp("compressor=\"vtkLZMADataCompressor\"", "<DataArray type=\"Float32\">1 2 3</DataArray>")));
    EXPECT_FALSE(refused(parse_vtp, vtp("", "<DataArray type=\"Float32\" format=\"ascii\">1 2 3</DataArray>")));
}

/// Many arrays with the same bytes: their sum is bounded, not each alone.
TEST(hostile_vtp, arrays_that_overlap) {
    const auto file = [](int pieces) {
        std::string text = "<VTKFile type=\"PolyData\"><PolyData>";
        for (int i = 0; i < pieces; ++i)
            text += "<Piece NumberOfPoints=\"1000\"><Points><DataArray type=\"UInt8\" format=\"appended\" offset=\"0\"/></Points></Piece>";
        return text + "</PolyData><AppendedData encoding=\"raw\">_" + std::string("\xb8\x0b\0\0", 4) + std::string(3000, '\1') +
               "</AppendedData></VTKFile>";
    };
    EXPECT_FALSE(refused(parse_vtp, file(1)));
    EXPECT_TRUE(refused(parse_vtp, file(20)));
}

TEST(hostile_vtp, messages_name_the_array) {
    const auto message = [](const std::string& attributes, const std::string& array, const std::string& appended) {
        try {
            (void)parse_vtp("<VTKFile type=\"PolyData\" " + attributes + "><PolyData><Piece NumberOfPoints=\"1\"><Points>" + array +
                                "</Points></Piece></PolyData>" + appended + "</VTKFile>",
                            "mesh");
        } catch (const Error& error) {
            return error.text().where + ": " + error.text().what + "; " + error.text().expected;
        }
        return std::string();
    };
    const std::string raw = "<AppendedData encoding=\"raw\">_";
    const std::string ascii = "<DataArray Name=\"P\" type=\"Int32\">1 2 x3</DataArray>";
    EXPECT_EQ(message("", ascii, ""), "array 'P': 'x3' is not a number of its type; number 3: Int32");
    const std::string text = "<DataArray Name=\"P\" type=\"String\">1</DataArray>";
    EXPECT_EQ(message("", text, ""), "array 'P': type 'String' is not numeric; Int8 to UInt64, Float32 or Float64");
    const std::string appended = "<DataArray Name=\"P\" type=\"Int32\" format=\"appended\" offset=\"0\"/>";
    EXPECT_EQ(message("", appended, ""), "array 'P': its data are in an appended section that the file does not have; <AppendedData>");
    EXPECT_EQ(message("", appended, raw + std::string("\x05\0\0\0abcde", 9)), "array 'P': it has 5 bytes; a multiple of 4: Int32");
    EXPECT_EQ(message("", appended, raw + std::string("\x64\0\0\0abcd", 8)), "array 'P': its header says 100 bytes; 14 at most");
    const std::string coded = "<DataArray Name=\"P\" type=\"Int32\" format=\"binary\">DA*=</DataArray>";
    EXPECT_NE(message("", coded, "").find("a character is not base64: '*'"), std::string::npos);
}

std::string glb(std::string json, std::string binary) {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    binary.resize((binary.size() + 3) / 4 * 4, '\0');
    const auto number = [](std::size_t value) {
        std::string text;
        for (int i = 0; i < 4; ++i) text += static_cast<char>(value >> (8 * i) & 0xff);
        return text;
    };
    return "glTF" + number(2) + number(12 + 8 + json.size() + 8 + binary.size()) + number(json.size()) + "JSON" + json +
           number(binary.size()) + std::string("BIN\0", 4) + binary;
}

TEST(hostile_glb, loops_repetition_and_wrong_types) {
    const std::string mesh =
        "\"buffers\":[{\"byteLength\":36}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],";
    const std::string zeros(36, '\0');
    EXPECT_FALSE(refused(parse_glb, glb("{" + mesh + "\"nodes\":[{\"mesh\":0}]}", zeros)));
    EXPECT_TRUE(refused(parse_glb, glb("{" + mesh + "\"nodes\":[{\"mesh\":0}]}", "")));
    EXPECT_TRUE(refused(parse_glb, glb("{" + mesh + "\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0,\"children\":[0]}]}", zeros)));
    EXPECT_TRUE(refused(parse_glb, glb("{" + mesh + "\"scenes\":[{\"nodes\":[4]}],\"nodes\":[{\"mesh\":0}]}", zeros)));
    EXPECT_TRUE(refused(parse_glb, glb("{" + mesh + "\"nodes\":[{\"mesh\":-1}]}", zeros)));
    EXPECT_TRUE(refused(parse_glb, glb("{" + mesh + "\"nodes\":\"seven\"}", zeros)));
    EXPECT_TRUE(refused(parse_glb, glb("{" + mesh + "\"nodes\":[{\"mesh\":0,\"matrix\":[1,2]}]}", zeros)));
    EXPECT_TRUE(refused(parse_glb, glb("{" + mesh + "\"extensionsRequired\":[\"KHR_draco_mesh_compression\"]}", zeros)));
    EXPECT_TRUE(refused(parse_glb, glb(std::string(100'000, '['), "")));
    std::string many = "{" + mesh + "\"nodes\":[{\"mesh\":0}";
    for (int i = 0; i < 1000; ++i) many += ",{\"mesh\":0}";
    EXPECT_FALSE(refused(parse_glb, glb(many + "]}", zeros)));  // 3 points a node: no more than the JSON's size
}

}  // namespace
