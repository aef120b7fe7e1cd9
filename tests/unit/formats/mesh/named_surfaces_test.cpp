// write_surfaces: several surfaces, each with a name, a colour and an isovalue, in one file of every format.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "isoatlas/sink.h"
#include "unit/formats/common/external.h"
#include "unit/formats/common/placed_volumes.h"
#include "unit/formats/mesh/mesh_samples.h"

using namespace isoatlas;
using mesh_samples::Folder;
using mesh_samples::read_bytes;

namespace {

constexpr const char* kExtensions[] = {".ply", ".stl", ".obj", ".vtp", ".glb"};

std::vector<NamedSurface> skin_and_skull(const std::string& space = "RAS", const std::string& unit = "mm") {
    const Volume volume = placed_volumes::ball({.origin = {3, 4, 5}, .space = space, .unit = unit});
    return {{extract(volume, 0.25), "skin", {230, 216, 186}}, {extract(volume, 0.9), "skull, \"upper\" part", {86, 180, 233}}};
}

std::int64_t triangles_of(const std::vector<NamedSurface>& surfaces) {
    std::int64_t count = 0;
    for (const NamedSurface& named : surfaces) count += static_cast<std::int64_t>(named.surface.triangles.size());
    return count;
}

TEST(NamedSurfaces, come_back_from_every_format) {
    const Folder folder;
    const std::vector<NamedSurface> surfaces = skin_and_skull();
    for (const std::string extension : kExtensions) {
        (void)write_surfaces(folder / ("both" + extension), surfaces);
        MemorySink sink("both" + extension);
        (void)write_surfaces(sink, surfaces);
        EXPECT_TRUE(sink.bytes() == read_bytes(folder / ("both" + extension))) << extension;
        const Mesh mesh = read_mesh(folder / ("both" + extension));
        EXPECT_EQ(static_cast<std::int64_t>(mesh.triangles.size()), triangles_of(surfaces)) << extension;
        EXPECT_EQ(mesh.space, extension == ".glb" ? "RAS" : "LPS") << extension;
        if (extension == ".stl" || extension == ".obj") continue;  // no numbers
        ASSERT_EQ(mesh.object.size(), mesh.points.size()) << extension;
        for (std::size_t i = 0; i < mesh.points.size(); ++i)
            EXPECT_EQ(mesh.object[i], i < surfaces[0].surface.points.size() ? 1 : 2) << extension;
    }
}

TEST(NamedSurfaces, names_colours_and_isovalues_are_in_the_file) {
    const Folder folder;
    for (const std::string extension : kExtensions) (void)write_surfaces(folder / ("both" + extension), skin_and_skull());
    const std::string ply = read_bytes(folder / "both.ply"), obj = read_bytes(folder / "both.obj");
    EXPECT_NE(ply.find("\ncomment object 1 tau 0.25 colour 230 216 186 name skin\n"), std::string::npos);
    EXPECT_NE(ply.find("\ncomment object 2 tau 0.9"), std::string::npos);
    EXPECT_NE(ply.find("\nproperty uchar red\n"), std::string::npos);
    EXPECT_NE(obj.find("\no skin\n"), std::string::npos);
    EXPECT_NE(obj.find("\no skull,_\"upper\"_part\n"), std::string::npos);
    const std::string glb = read_bytes(folder / "both.glb");
    std::uint32_t size = 0;
    std::memcpy(&size, glb.data() + 12, 4);
    const nlohmann::json json = nlohmann::json::parse(glb.substr(20, size));
    ASSERT_EQ(json["nodes"].size(), 3U);
    EXPECT_EQ(json["nodes"][1]["name"], "skin");
    EXPECT_EQ(json["nodes"][2]["name"], "skull, \"upper\" part");
    EXPECT_EQ(json["nodes"][2]["extras"]["tau"], 0.9);
    EXPECT_EQ(json["materials"][1]["name"], "skull, \"upper\" part");
    EXPECT_NEAR(json["materials"][1]["pbrMetallicRoughness"]["baseColorFactor"][0].get<double>(), 0.0931, 1e-4);  // sRGB 86
    EXPECT_EQ(json["meshes"][1]["primitives"][0]["material"], 1);
}

TEST(NamedSurfaces, vtk_sees_names_and_numbers) {
    if (!external::has_vtk()) GTEST_SKIP() << "VTK (package python3-vtk9) is not installed";
    const Folder folder;
    (void)write_surfaces(folder / "both.vtp", skin_and_skull());
    const external::Result result =
        external::python("import vtk\nr = vtk.vtkXMLPolyDataReader()\nr.SetFileName('" + (folder / "both.vtp") +
                         "')\nr.Update()\np = r.GetOutput()\nf = p.GetFieldData()\nn = f.GetAbstractArray('ObjectName')\n"
                         "print([n.GetValue(i) for i in range(n.GetNumberOfValues())], f.GetArray('Tau').GetNumberOfTuples(), "
                         "p.GetPointData().GetArray('Object').GetRange(), p.GetPointData().GetArray('Colour').GetTuple3(0))");
    EXPECT_EQ(result.text, "['skin', 'skull, \"upper\" part'] 2 (1.0, 2.0) (230.0, 216.0, 186.0)\n");
}

TEST(NamedSurfaces, wrong_use) {
    const Folder folder;
    const auto kind = [&](const std::vector<NamedSurface>& surfaces, const std::string& name) {
        try {
            (void)write_surfaces(folder / name, surfaces);
        } catch (const Error& error) {
            return error.kind();
        }
        return ErrorKind::internal;
    };
    std::vector<NamedSurface> mixed = skin_and_skull();
    mixed.push_back(skin_and_skull("LPS").front());
    std::vector<NamedSurface> units = skin_and_skull();
    units.push_back(skin_and_skull("RAS", "um").front());
    std::vector<NamedSurface> curves = skin_and_skull("unknown", "");
    curves.push_back({mesh_samples::curve(), "curve", {}});
    for (const std::string extension : kExtensions) {
        EXPECT_EQ(kind({}, "x" + extension), ErrorKind::usage);
        EXPECT_EQ(kind(mixed, "x" + extension), ErrorKind::usage);
        EXPECT_EQ(kind(units, "x" + extension), ErrorKind::usage);
        EXPECT_EQ(kind(curves, "x" + extension), ErrorKind::usage);
    }
    EXPECT_EQ(kind(skin_and_skull(), "x.fbx"), ErrorKind::usage);
    EXPECT_EQ(folder.files(), 0U);
}

/// The validator of the Khronos Group (npm: gltf-validator) has nothing to say against our files.
TEST(GltfValidator, finds_no_errors_and_no_warnings) {
    const std::string validator = std::string(ISOATLAS_NODE_MODULES) + "/gltf-validator";
    if (external::run("node -e \"require('" + validator + "')\"").status != 0)
        GTEST_SKIP() << "node or its module gltf-validator is not installed";
    const Folder folder;
    int number = 0;
    for (const auto& placed : placed_volumes::placed_geometries()) {
        const Volume volume = placed_volumes::ball(placed.geometry);
        for (const Boundary boundary : {Boundary::closed, Boundary::open}) {
            ExtractOptions options;
            options.surface.boundary = boundary;
            Surface surface = extract(volume, 0.5, options);
            (void)write_surface(folder / (std::to_string(number++) + ".glb"), surface);
            surface.normals.clear();
            surface.object.clear();
            (void)write_surface(folder / (std::to_string(number++) + ".glb"), surface);
        }
    }
    (void)write_surface(folder / "empty.glb", Surface{});
    (void)write_surface(folder / "two.glb", mesh_samples::two_objects());
    (void)write_surfaces(folder / "named.glb", skin_and_skull());
    const external::Result result =
        external::run("node -e \"const v = require('" + validator + "'), fs = require('fs'), f = '" + (folder / "") +
                      "'; (async () => { let n = 0; for (const name of fs.readdirSync(f)) { const r = await v.validateBytes(new "
                      "Uint8Array(fs.readFileSync(f + name))); if (r.issues.numErrors + r.issues.numWarnings > 0) console.log(name, "
                      "JSON.stringify(r.issues.messages.slice(0, 3))); n += 1; } console.log('validated', n); })()\"");
    EXPECT_EQ(result.text, "validated " + std::to_string(number + 3) + "\n");
}

}  // namespace
