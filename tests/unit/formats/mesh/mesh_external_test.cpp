// Every written format is opened by a reader that is not ours, and the numbers agree.
#include <gtest/gtest.h>

#include "unit/formats/common/external.h"
#include "unit/formats/mesh/mesh_samples.h"

using namespace isoatlas;
using namespace mesh_samples;

namespace {

/// The number that follows `label` in the text; -1: there is none.
long number_after(const std::string& text, const std::string& label) {
    const std::size_t at = text.find(label);
    return at == std::string::npos ? -1 : std::stol(text.substr(at + label.size()));
}

class Assimp : public testing::TestWithParam<const char*> {};

TEST_P(Assimp, opens_the_file_and_counts_the_same) {
    if (!external::has_assimp()) GTEST_SKIP() << "assimp (package assimp-utils) is not installed";
    const Folder folder;
    for (const Surface& surface : {two_objects(), far_away()}) {
        if (surface.reported_tau < 0 && std::string(GetParam()) == ".stl") continue;  // float32 cannot hold it: warned about
        const std::string path = folder / (std::string("mesh") + GetParam());
        write_surface(path, surface);
        const external::Result info = external::run("assimp info '" + path + "' --raw");
        ASSERT_EQ(info.status, 0) << info.text;
        EXPECT_EQ(number_after(info.text, "Faces:"), static_cast<long>(surface.triangles.size())) << info.text;
        if (std::string(GetParam()) == ".glb") {
            EXPECT_EQ(number_after(info.text, "Meshes:"), surface.reported_tau < 0 ? 1 : 2);
            EXPECT_EQ(number_after(info.text, "Vertices:"), static_cast<long>(surface.points.size()));
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Formats, Assimp, testing::Values(".ply", ".stl", ".obj", ".glb"),
                         [](const auto& format) { return std::string(format.param).substr(1); });

struct VtkReader {
    const char* extension;
    const char* reader;
};
class Vtk : public testing::TestWithParam<VtkReader> {};

TEST_P(Vtk, opens_the_file_and_counts_the_same) {
    if (!external::has_vtk()) GTEST_SKIP() << "VTK (package python3-vtk9) is not installed";
    const Folder folder;
    const Surface surface = two_objects();
    const std::string path = folder / (std::string("mesh") + GetParam().extension);
    write_surface(path, surface);
    const external::Result result =
        external::python(std::string("import vtk\nr = vtk.") + GetParam().reader + "()\nr.SetFileName('" + path +
                         "')\nr.Update()\np = r.GetOutput()\nprint('points', p.GetNumberOfPoints(), 'polys', p.GetNumberOfPolys())\n"
                         "m = vtk.vtkMassProperties()\nm.SetInputData(p)\nm.Update()\nprint('volume', round(m.GetVolume(), 3))\n"
                         "a = p.GetPointData().GetArray('ObjectId')\nprint('id', int(a.GetRange()[1]) if a else 'none')\n"
                         "t = p.GetFieldData().GetArray('Tau')\nprint('tau', t.GetValue(0) if t else 'none')\n"
                         "s = p.GetFieldData().GetAbstractArray('Unit')\nprint('unit', s.GetValue(0) if s else 'none')\n");
    ASSERT_EQ(result.status, 0) << result.text;
    EXPECT_NE(result.text.find("points 18 polys 24"), std::string::npos) << result.text;
    EXPECT_NE(result.text.find("volume 88.5"), std::string::npos)
        << result.text;  // 4/3 (4^3 + 1.5^3 - 1^3): outward normals, cavity inward
    if (std::string(GetParam().extension) == ".vtp") {
        EXPECT_NE(result.text.find("id 5000000000"), std::string::npos) << result.text;
        EXPECT_NE(result.text.find("tau 100.5"), std::string::npos) << result.text;
        EXPECT_NE(result.text.find("unit mm"), std::string::npos) << result.text;
    }
}

INSTANTIATE_TEST_SUITE_P(Formats, Vtk,
                         testing::Values(VtkReader{".ply", "vtkPLYReader"}, VtkReader{".stl", "vtkSTLReader"},
                                         VtkReader{".obj", "vtkOBJReader"}, VtkReader{".vtp", "vtkXMLPolyDataReader"}),
                         [](const auto& format) { return std::string(format.param.extension).substr(1); });

TEST(vtk, opens_curves_and_empty_surfaces) {
    if (!external::has_vtk()) GTEST_SKIP() << "VTK (package python3-vtk9) is not installed";
    const Folder folder;
    write_surface(folder / "curve.vtp", curve());
    write_surface(folder / "empty.vtp", Surface{});
    for (const auto& [name, expected] : {std::pair{"curve.vtp", "4 4 0"}, std::pair{"empty.vtp", "0 0 0"}}) {
        const external::Result result = external::python("import vtk\nr = vtk.vtkXMLPolyDataReader()\nr.SetFileName('" + (folder / name) +
                                                         "')\nr.Update()\np = r.GetOutput()\n"
                                                         "print(p.GetNumberOfPoints(), p.GetNumberOfLines(), p.GetNumberOfPolys())");
        EXPECT_EQ(result.text, std::string(expected) + "\n");
    }
}

/// The other way round: what VTK writes in each of its encodings, we read.
TEST(vtk, its_files_are_read) {
    if (!external::has_vtk()) GTEST_SKIP() << "VTK (package python3-vtk9) is not installed";
    const Folder folder;
    const external::Result result = external::python(
        "import vtk\ns = vtk.vtkSphereSource()\ns.Update()\np = s.GetOutput()\n"
        "for mode in ('Ascii', 'Binary', 'Appended'):\n  for zlib in (0, 1):\n    for header in (32, 64):\n      for big in (0, 1):\n"
        "        w = vtk.vtkXMLPolyDataWriter()\n        w.SetInputData(p)\n        getattr(w, 'SetDataModeTo' + mode)()\n"
        "        (w.SetCompressorTypeToZLib if zlib else w.SetCompressorTypeToNone)()\n        w.SetHeaderType(header)\n"
        "        (w.SetByteOrderToBigEndian if big else w.SetByteOrderToLittleEndian)()\n"
        "        for raw in (0, 1):\n          w.SetEncodeAppendedData(1 - raw)\n"
        "          w.SetFileName('" +
        (folder / "x") +
        "%s%d%d%d%d.vtp' % (mode, zlib, header, big, raw))\n          assert w.Write() == 1\n"
        "for mode in ('ASCII', 'Binary'):\n  w = vtk.vtkSTLWriter()\n  w.SetInputData(p)\n  getattr(w, 'SetFileTypeTo' + mode)()\n"
        "  w.SetFileName('" +
        (folder / "x") +
        "%s.stl' % mode)\n  w.Write()\n"
        "  w = vtk.vtkPLYWriter()\n  w.SetInputData(p)\n  getattr(w, 'SetFileTypeTo' + mode)()\n  w.SetFileName('" +
        (folder / "x") +
        "%s.ply' % mode)\n  w.Write()\n"
        "print(p.GetNumberOfPoints(), p.GetNumberOfPolys())");
    ASSERT_EQ(result.text, "50 96\n");
    EXPECT_EQ(folder.files(), 52U);
    for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(folder / ""))) {
        const Mesh mesh = read_mesh(entry.path().string());
        EXPECT_EQ(mesh.points.size(), 50U) << entry.path();
        EXPECT_EQ(mesh.triangles.size(), 96U) << entry.path();
    }
}

TEST(gltf, the_json_follows_the_specification) {
    if (!external::has_python()) GTEST_SKIP() << "/usr/bin/python3 is not installed";
    const Folder folder;
    write_surface(folder / "mesh.glb", two_objects());
    write_surface(folder / "empty.glb", Surface{});
    const external::Result result = external::python(
        "import json, struct\n"
        "def load(name):\n"
        "  b = open(name, 'rb').read()\n  magic, version, total, size, kind = struct.unpack('<4sIII4s', b[:20])\n"
        "  assert (magic, version, total, kind) == (b'glTF', 2, len(b), b'JSON') and size % 4 == 0\n"
        "  return json.loads(b[20:20 + size]), b[28 + size:], b[20 + size:28 + size]\n"
        "g, data, chunk = load('" +
        (folder / "mesh.glb") +
        "')\n"
        "assert struct.unpack('<I4s', chunk) == (len(data), b'BIN\\0') and g['buffers'][0]['byteLength'] == len(data)\n"
        "root, n = g['nodes'][0], g['nodes'][1:]\n"
        "assert g['scenes'] == [{'nodes': [0]}] and root['children'] == [1, 2] and root['extras']['frame'] == 'volume'\n"
        "assert root['matrix'] == [.001, 0, 0, 0, 0, 0, -.001, 0, 0, .001, 0, 0, 0, 0, 0, 1]\n"
        "assert [x['extras']['object'] for x in n] == [7, 5000000000] and n[0]['extras']['tau'] == 100.5\n"
        "assert n[0]['extras']['unit'] == 'mm' and n[0]['extras']['space'] == 'LPS' and g['asset']['version'] == '2.0'\n"
        "assert [m['primitives'][0]['material'] for m in g['meshes']] == [0, 1] and len(g['materials']) == 2\n"
        "used = set()\n"
        "for m in g['meshes']:\n"
        "  p = m['primitives'][0]\n"
        "  for key, index in list(p['attributes'].items()) + [('indices', p['indices'])]:\n"
        "    a = g['accessors'][index]\n    v = g['bufferViews'][a['bufferView']]\n    assert index not in used and v['byteOffset'] % 4 == "
        "0\n"
        "    used.add(index)\n"
        "    n = a['count'] * (1 if key == 'indices' else 3)\n    assert v['byteLength'] == 4 * n\n"
        "    x = struct.unpack_from('<%d%s' % (n, 'I' if key == 'indices' else 'f'), data, v['byteOffset'])\n"
        "    if key == 'POSITION':\n"
        "      assert a['min'] == [min(x[i::3]) for i in range(3)] and a['max'] == [max(x[i::3]) for i in range(3)]\n      points = "
        "a['count']\n"
        "    if key == 'indices': assert max(x) < points\n"
        "    if key == 'NORMAL': assert all(abs(sum(c * c for c in x[i:i + 3]) - 1) < 1e-6 for i in range(0, n, 3))\n"
        "assert len(used) == len(g['accessors']) == len(g['bufferViews'])\n"
        "e, _, _ = load('" +
        (folder / "empty.glb") +
        "')\n"
        "assert e['scenes'] == [{}] and not {'nodes', 'meshes', 'buffers', 'accessors', 'bufferViews'} & set(e)\n"
        "print('good')");
    EXPECT_EQ(result.text, "good\n");
}

}  // namespace
