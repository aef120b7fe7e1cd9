// The usual variants of the mesh formats, as other programs write them.
#include <gtest/gtest.h>

#include <bit>
#include <cstring>

#include "formats/mesh/mesh_formats.h"
#include "unit/formats/mesh/mesh_samples.h"

using namespace isoatlas;
using namespace mesh_samples;

namespace {

using Triangles = isoatlas::Array<std::array<std::int64_t, 3>>;

template <class T>
std::string bytes_of_number(T value, bool big_endian) {
    std::string bytes(sizeof(T), '\0');
    std::memcpy(bytes.data(), &value, sizeof(T));
    if (big_endian) std::reverse(bytes.begin(), bytes.end());
    return bytes;
}

TEST(ply_variants, ascii_with_polygons_comments_and_foreign_properties) {
    const Mesh mesh = parse_ply(
        "ply\r\nformat ascii 1.0\r\ncomment made by hand\r\nobj_info none\r\nelement material 1\r\nproperty int shine\r\n"
        "element vertex 5\r\nproperty uchar red\r\nproperty float64 y\r\nproperty double x\r\nproperty float z\r\n"
        "property list uchar int neighbours\r\nelement face 2\r\nproperty uchar flags\r\nproperty list uint8 int32 "
        "vertex_index\r\nend_header\r\n"
        "77\r\n255 2 1 3 2 8 9\r\n0 5 4 6 0\r\n0 8 7 9 0\r\n0 1 1 1 0\r\n0 +2.5e0 2 -2 0\r\n1 4 0 1 2 3\r\n1 3 2 3 4\r\n",
        "a.ply");
    EXPECT_EQ(mesh.points, (isoatlas::Array<Point>{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {1, 1, 1}, {2, 2.5, -2}}));
    EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}, {2, 3, 4}}));
    EXPECT_TRUE(mesh.object.empty());
}

TEST(ply_variants, both_byte_orders_and_every_scalar_type) {
    for (const bool big : {false, true}) {
        std::string file = std::string("ply\nformat binary_") + (big ? "big" : "little") +
                           "_endian 1.0\nelement vertex 3\nproperty char x\nproperty ushort y\nproperty double z\nproperty uint object\n"
                           "property short contour\nelement face 1\nproperty list ushort short vertex_indices\nend_header\n";
        for (int i = 0; i < 3; ++i) {
            file += bytes_of_number(static_cast<std::int8_t>(-i), big) + bytes_of_number(static_cast<std::uint16_t>(40000 + i), big) +
                    bytes_of_number(0.1 * i, big) + bytes_of_number(4'000'000'000U + static_cast<unsigned>(i), big) +
                    bytes_of_number(static_cast<std::int16_t>(-7 * i), big);
        }
        file += bytes_of_number(std::uint16_t{3}, big);
        for (const std::int16_t corner : std::array<std::int16_t, 3>{2, 1, 0}) file += bytes_of_number(corner, big);
        const Mesh mesh = parse_ply(file, "b.ply");
        EXPECT_EQ(mesh.points, (isoatlas::Array<Point>{{0, 40000, 0}, {-1, 40001, 0.1}, {-2, 40002, 0.2}}));
        EXPECT_EQ(mesh.triangles, (Triangles{{2, 1, 0}}));
        EXPECT_EQ(mesh.object, (isoatlas::Array<std::int64_t>{4'000'000'000, 4'000'000'001, 4'000'000'002}));
        EXPECT_EQ(mesh.contour, (isoatlas::Array<std::int64_t>{0, -7, -14}));
    }
}

TEST(ply_variants, a_property_named_object_that_holds_fractions_is_not_ours) {
    const Mesh mesh = parse_ply(
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nproperty float "
        "object\nend_header\n0 0 0 0.5\n",
        "c.ply");
    EXPECT_EQ(mesh.points.size(), 1U);
    EXPECT_TRUE(mesh.object.empty());
}

TEST(stl_variants, text_with_two_solids_shares_equal_points) {
    const Mesh mesh = parse_stl(
        "solid first facet solid\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n   vertex 0 1 0\n  endloop\n "
        "endfacet\n"
        " facet normal nan nan nan\n  outer loop\n   vertex 1 0 -0.0\n   vertex 1e0 1.0 0\n   vertex 0 1 0\n  endloop\n endfacet\nendsolid "
        "first\n"
        "solid\nendsolid\n",
        "a.stl");
    EXPECT_EQ(mesh.points.size(), 4U);
    EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {1, 3, 2}}));
}

TEST(stl_variants, binary_that_starts_with_solid) {
    std::string bytes = "solid made by a careless program";
    bytes.resize(80, ' ');
    bytes += bytes_of_number(std::uint32_t{1}, false);
    for (const float x : {0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F}) bytes += bytes_of_number(x, false);
    bytes += std::string(2, '\0');
    EXPECT_EQ(parse_stl(bytes, "b.stl").triangles, (Triangles{{0, 1, 2}}));
}

TEST(obj_variants, all_forms_of_indices) {
    const Mesh mesh = parse_obj(
        "# comment\nmtllib x.mtl\no thing\nv 0 0 0\nv 1 0 0 # a corner\nv 1 1 0 1.0\nv 0 1 0 0.5 0.5 0.5\nvt 0 0\nvn 0 0 1\ng side\ns "
        "off\nusemtl red\n"
        "f 1/1/1 2/1/1 3/1/1 4/1/1\nf 1//1 2//1 \\\n  3//1\nf 1/1 2/1 3/1\nf -4 -3 -1\nl 1 2\np 3\n",
        "a.obj");
    EXPECT_EQ(mesh.points.size(), 4U);
    EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}, {0, 1, 2}, {0, 1, 2}, {0, 1, 3}}));
    EXPECT_TRUE(mesh.object.empty());
}

TEST(obj_variants, wrong_indices_and_statements_are_refused) {
    for (const char* text :
         {"f 0 1 2\n", "f -1 -2 -3\n", "v 0 0 0\nf 1 1\n", "v 0 0 0\nf 1 1 2\n", "v 0 0\n", "hello world\n", "f 1 x 2\n"}) {
        EXPECT_THROW((void)parse_obj(text, "b.obj"), Error) << text;
    }
}

/// A square as VTK 9.1 writes it by default: base64, zlib, UInt32 block headers.
constexpr const char* kVtkDefault = R"(<?xml version="1.0"?>
<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian" header_type="UInt32" compressor="vtkZLibDataCompressor">
  <PolyData>
    <Piece NumberOfPoints="4" NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys="1">
      <Points>
        <DataArray type="Float32" Name="Points" NumberOfComponents="3" format="appended" offset="0"/>
      </Points>
      <Strips>
        <DataArray type="Int64" Name="connectivity" format="appended" offset="60"/>
        <DataArray type="Int64" Name="offsets" format="appended" offset="76"/>
      </Strips>
      <Polys>
        <DataArray type="Int64" Name="connectivity" format="appended" offset="92"/>
        <DataArray type="Int64" Name="offsets" format="appended" offset="144"/>
      </Polys>
    </Piece>
  </PolyData>
  <AppendedData encoding="base64">
   _AQAAAACAAAAwAAAAGQAAAA==eJxjYGDYzwDBIGCPxN4P5cPEwWwAdWgD+Q==AAAAAACAAAAAAAAAAAAAAACAAAAAAAAAAQAAAACAAAAgAAAAEwAAAA==eJxjYIAARijNDKWZoDQAAHgABw==AQAAAACAAAAIAAAACwAAAA==eJxjYYAAAAAoAAU=
  </AppendedData>
</VTKFile>
)";

TEST(vtp_variants, default_output_of_vtk) {
    const Mesh mesh = parse_vtp(kVtkDefault, "a.vtp");
    EXPECT_EQ(mesh.points, (isoatlas::Array<Point>{{-0.5, -0.5, 0}, {0.5, -0.5, 0}, {-0.5, 0.5, 0}, {0.5, 0.5, 0}}));
    EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 3}, {0, 3, 2}}));
}

TEST(vtp_variants, ascii_pieces_strips_big_endian_and_ids) {
    const std::string piece =
        R"(<Piece NumberOfPoints="4"><PointData><DataArray type="Int64" Name="ObjectId">1 2 3 9007199254740993</DataArray></PointData>
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0  1 0 0  0 1 0  1e0 +1 0</DataArray></Points>
<Strips><DataArray type="UInt8" Name="connectivity">0 1 2 3</DataArray><DataArray type="Int32" Name="offsets">4</DataArray></Strips></Piece>)";
    const Mesh mesh =
        parse_vtp("<VTKFile type=\"PolyData\" byte_order=\"BigEndian\"><PolyData>" + piece + piece + "</PolyData></VTKFile>", "b.vtp");
    EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {2, 1, 3}, {4, 5, 6}, {6, 5, 7}}));
    EXPECT_EQ(mesh.object, (isoatlas::Array<std::int64_t>{1, 2, 3, 9007199254740993, 1, 2, 3, 9007199254740993}));
    const std::string array = "<DataArray type=\"UInt16\" NumberOfComponents=\"3\" format=\"binary\">AAAABgABAAIAAw==</DataArray>";
    const Mesh big = parse_vtp("<VTKFile type=\"PolyData\" byte_order=\"BigEndian\"><PolyData><Piece NumberOfPoints=\"1\"><Points>" +
                                   array + "</Points></Piece></PolyData></VTKFile>",
                               "c.vtp");
    EXPECT_EQ(big.points, (isoatlas::Array<Point>{{1, 2, 3}}));
}

std::string glb(std::string json, std::string binary) {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    binary.resize((binary.size() + 3) / 4 * 4, '\0');
    const auto number = [](std::size_t value) { return bytes_of_number(static_cast<std::uint32_t>(value), false); };
    return "glTF" + number(2) + number(12 + 8 + json.size() + 8 + binary.size()) + number(json.size()) + "JSON" + json +
           number(binary.size()) + std::string("BIN\0", 4) + binary;
}

TEST(glb_variants, transforms_children_strides_and_short_indices) {
    std::string binary;
    for (int i = 0; i < 3; ++i) {  // positions 16 bytes apart
        for (const int x : {i == 1 ? 1 : 0, i == 2 ? 1 : 0, 0, 99}) binary += bytes_of_number(static_cast<float>(x), false);
    }
    for (const std::uint16_t corner : std::array<std::uint16_t, 3>{0, 1, 2}) binary += bytes_of_number(corner, false);
    const std::string json = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[1]}],
"nodes":[{"mesh":0,"scale":[-1,1,1],"extras":{"object":6}},{"translation":[10,20,30],"children":[0,2]},
         {"mesh":0,"matrix":[0,1,0,0,-1,0,0,0,0,0,1,0,0,0,5,1],"extras":{"object":5000000000}}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1},{"attributes":{"POSITION":0},"mode":1}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},{"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteLength":48,"byteStride":16},{"buffer":0,"byteOffset":48,"byteLength":6}],"buffers":[{"byteLength":54}]})";
    const Mesh mesh = parse_glb(glb(json, binary), "a.glb");
    EXPECT_EQ(mesh.points, (isoatlas::Array<Point>{{10, 20, 30}, {9, 20, 30}, {10, 21, 30}, {10, 20, 35}, {10, 21, 35}, {9, 20, 35}}));
    EXPECT_EQ(mesh.triangles, (Triangles{{0, 2, 1}, {3, 4, 5}}));  // the mirrored one is turned over
    EXPECT_EQ(mesh.object, (isoatlas::Array<std::int64_t>{6, 6, 6, 5'000'000'000, 5'000'000'000, 5'000'000'000}));
}

TEST(glb_variants, rotation_and_no_indices) {
    std::string binary;
    for (const float x : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F}) binary += bytes_of_number(x, false);
    const std::string json = R"({"nodes":[{"mesh":0,"rotation":[0,0,1,0]}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36}]})";
    const Mesh mesh = parse_glb(glb(json, binary), "b.glb");  // half a turn around z
    EXPECT_EQ(mesh.points, (isoatlas::Array<Point>{{0, 0, 0}, {-1, 0, 0}, {0, -1, 0}}));
    EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}}));
    EXPECT_TRUE(mesh.object.empty());
}

}  // namespace
