// A mesh lies where its volume lies: read by us, by VTK, and as 3D Slicer reads it; in every space, also oblique, mirrored and unit-less.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "oracle/write_file.h"
#include "unit/formats/common/external.h"
#include "unit/formats/common/placed_volumes.h"
#include "unit/formats/mesh/mesh_samples.h"

using namespace isoatlas;
using namespace placed_volumes;
using mesh_samples::Folder;

namespace {

constexpr double kTau = 0.5;
constexpr double kVoxel = 1e-3;  // what may be lost, in voxels

Surface surface_of(const Geometry& geometry) { return extract(ball(geometry), kTau); }

/// The largest distance of a point, in voxels, from the nearest point of the surface of the ball, in coordinates of the voxels.
double distance(const isoatlas::Array<Vec3>& points, const Affine& affine, const isoatlas::Array<Vec3>& expected) {
    double largest = 0;
    for (const Vec3& point : points) {
        const Vec3 v = voxel_of(affine, point);
        double nearest = 1e300;
        for (const Vec3& e : expected) nearest = std::min(nearest, std::hypot(v[0] - e[0], v[1] - e[1], v[2] - e[2]));
        largest = std::max(largest, nearest);
    }
    return largest;
}

/// Six times the volume that the triangles enclose; above 0: they are counter-clockwise from outside.
double enclosed(const isoatlas::Array<Vec3>& points, const isoatlas::Array<std::array<std::int64_t, 3>>& triangles) {
    const Vec3 o = points.at(0);
    double sum = 0;
    for (const auto& t : triangles) {
        std::array<Vec3, 3> corner{};
        for (std::size_t k = 0; k < 3; ++k) {
            for (std::size_t a = 0; a < 3; ++a) corner[k][a] = points[t[k]][a] - o[a];
        }
        const auto& [p, q, r] = corner;
        sum += p[0] * (q[1] * r[2] - q[2] * r[1]) - p[1] * (q[0] * r[2] - q[2] * r[0]) + p[2] * (q[0] * r[1] - q[1] * r[0]);
    }
    return sum;
}

isoatlas::Array<Vec3> in_voxels(const Surface& surface, const Geometry& geometry) {
    isoatlas::Array<Vec3> points;
    for (const Vec3& point : surface.points) points.push_back(voxel_of(affine_of(geometry), point));
    return points;
}

std::string expected_space(const std::string& extension, const Geometry& geometry, PointSpace wanted) {
    if (extension == ".glb" || wanted == PointSpace::volume || geometry.space == "unknown") return geometry.space;
    return wanted == PointSpace::ras ? "RAS" : "LPS";
}

class PlacedMeshes : public testing::TestWithParam<const char*> {
protected:
    [[nodiscard]] std::string path(const std::string& name = "mesh") const { return folder_ / (name + GetParam()); }
    Folder folder_;
};

TEST_P(PlacedMeshes, are_read_back_where_the_volume_is) {
    for (const Placed& placed : placed_geometries()) {
        const Surface surface = surface_of(placed.geometry);
        for (const PointSpace wanted : {PointSpace::lps, PointSpace::ras, PointSpace::volume}) {
            SCOPED_TRACE(std::string(placed.name) + " " + std::to_string(static_cast<int>(wanted)));
            const std::vector<std::string> warnings = write_surface(path(), surface, {.space = wanted});
            const Mesh mesh = read_mesh(path());
            const std::string space = expected_space(GetParam(), placed.geometry, wanted);
            EXPECT_EQ(mesh.space, space);
            EXPECT_EQ(mesh.unit, placed.geometry.unit);
            const bool is_stl = std::string(GetParam()) == ".stl";
            if (is_stl && warnings.size() > 1) continue;  // float32 cannot hold these places, and the warning says so
            ASSERT_EQ(mesh.triangles.size(), surface.triangles.size());
            EXPECT_EQ(mesh.points.size(), surface.points.size());
            EXPECT_LT(distance(mesh.points, affine_in(placed.geometry, space), in_voxels(surface, placed.geometry)), kVoxel);
            const double ratio = enclosed(mesh.points, mesh.triangles) / enclosed(surface.points, surface.triangles);
            EXPECT_NEAR(ratio, 1, 1e-3);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Formats, PlacedMeshes, testing::Values(".ply", ".stl", ".obj", ".vtp", ".glb"),
                         [](const auto& format) { return std::string(format.param).substr(1); });

/// What a file says to Slicer, and where VTK has its points; GLB with the matrices of its nodes.
constexpr const char* kReadAll = R"(
import sys, numpy, vtk
from vtk.util.numpy_support import vtk_to_numpy
def said(text):
    return 'RAS' if 'SPACE=RAS' in text else 'LPS' if 'SPACE=LPS' in text else None
def load(name):
    end = name[-4:]
    if end == '.glb':
        r = vtk.vtkGLTFReader(); r.SetFileName(name); r.Update()
        parts, it = [], r.GetOutput().NewIterator()
        while not it.IsDoneWithTraversal():
            parts.append(vtk_to_numpy(it.GetCurrentDataObject().GetPoints().GetData()).astype(float)); it.GoToNextItem()
        return numpy.concatenate(parts), None
    r = {'.ply': vtk.vtkPLYReader, '.stl': vtk.vtkSTLReader, '.obj': vtk.vtkOBJReader, '.vtp': vtk.vtkXMLPolyDataReader}[end]()
    r.SetFileName(name); r.Update(); p = r.GetOutput()
    points = vtk_to_numpy(p.GetPoints().GetData()).astype(float)
    if end in ('.ply', '.vtp'):  # normals agree with the order of corners
        polys = vtk_to_numpy(p.GetPolys().GetConnectivityArray()).reshape(-1, 3)
        a, n = points[polys], vtk_to_numpy(p.GetPointData().GetNormals())[polys].sum(axis=1)
        across = numpy.cross(a[:, 1] - a[:, 0], a[:, 2] - a[:, 0])
        assert ((across * n).sum(axis=1) > 0).mean() > 0.95, name
    if end == '.stl': return points, said(r.GetHeader() or '')
    if end == '.obj': return points, said(r.GetComment() or '')
    if end == '.ply':
        c = r.GetComments(); return points, said(' '.join(c.GetValue(i) for i in range(c.GetNumberOfValues())))
    a = p.GetFieldData().GetAbstractArray('SPACE'); return points, a.GetValue(0) if a else None
def far(points, affine, expected):
    a = numpy.linalg.inv(numpy.array(affine, dtype=float))
    v = (points - numpy.array(affine, dtype=float)[:3, 3]) @ a[:3, :3].T
    return max(numpy.sqrt(((expected - x) ** 2).sum(axis=1)).min() for x in v)
def slicer(points, space):  # Slicer turns all but RAS
    return points if space == 'RAS' else points * [-1, -1, 1]
)";

std::string python_points(const isoatlas::Array<Vec3>& points) {
    std::ostringstream text;
    text.precision(17);
    text << "numpy.array([";
    for (const Vec3& p : points) text << "[" << p[0] << "," << p[1] << "," << p[2] << "],";
    text << "])";
    return text.str();
}

/// Rows 0 and 1 reversed: what a program that takes LPS for RAS, and turns it, sees.
Affine turned(Affine rows) {
    for (std::size_t row = 0; row < 2; ++row) {
        for (double& x : rows[row]) x = -x;
    }
    return rows;
}

TEST_P(PlacedMeshes, lie_on_the_volume_in_vtk_and_slicer) {
    if (!external::has_vtk()) GTEST_SKIP() << "VTK (package python3-vtk9) is not installed";
    const std::string extension = GetParam();
    std::string program = kReadAll;
    int number = 0;
    for (const Placed& placed : placed_geometries()) {
        if (placed.geometry.origin[0] > 1e5) continue;  // readers of VTK give float32
        const Surface surface = surface_of(placed.geometry);
        for (const PointSpace wanted : {PointSpace::lps, PointSpace::ras}) {
            const std::string file = path("m" + std::to_string(number++));
            write_surface(file, surface, {.space = wanted});
            const bool known = placed.geometry.space != "unknown", is_glb = extension == ".glb";
            const std::string space = wanted == PointSpace::ras ? "RAS" : "LPS";
            program += "e = " + python_points(in_voxels(surface, placed.geometry)) + "\np, space = load('" + file + "')\n";
            program +=
                std::string("assert space == ") + (known && !is_glb ? "'" + space + "'" : "None") + ", ('" + placed.name + "', space)\n";
            const Affine affine = is_glb ? affine_in_gltf(placed) : affine_in(placed.geometry, space);
            program += "d = far(p, " + python_text(affine) + ", e)\nassert d < 1e-3, ('" + placed.name + "', 'vtk', d)\n";
            // Slicer has the volume in RAS; one without a space it takes as LPS, as ITK does
            const Affine ras = known ? affine_in(placed.geometry, "RAS") : turned(affine_of(placed.geometry));
            if (!is_glb)
                program +=
                    "d = far(slicer(p, space), " + python_text(ras) + ", e)\nassert d < 1e-3, ('" + placed.name + "', 'slicer', d)\n";
        }
    }
    const external::Result result = external::python(program + "print('good')");
    EXPECT_EQ(result.text, "good\n");
}

TEST(GlbFrame, units_and_moved_models) {
    const Folder folder;
    const auto warns = [&](const std::string& unit) {
        Surface surface = surface_of({.unit = unit});
        surface.contour.clear();  // about which it would warn
        return write_surface(folder / "u.glb", surface);
    };
    for (const char* unit : {"m", "cm", "mm", "um", "\xc2\xb5m", "nm", "A", "km", "in"}) EXPECT_TRUE(warns(unit).empty()) << unit;
    for (const char* unit : {"", "pixel", "furlong"}) EXPECT_EQ(warns(unit).size(), 1U) << unit;
    // a model that somebody turned is where it was put
    write_surface(folder / "a.glb", surface_of({.space = "RAS", .unit = "mm"}));
    std::string bytes = mesh_samples::read_bytes(folder / "a.glb");
    const std::string matrix = "\"matrix\":[-0.001,0,0,0,0,0,0.001,0,0,0.001,0,0,0,0,0,1]";
    const std::size_t at = bytes.find(matrix);
    ASSERT_NE(at, std::string::npos) << bytes.substr(0, 600);
    bytes.replace(at + 10, 6, "+0.001");
    bytes[at + 10] = ' ';
    oracle::write_file(folder / "b.glb", bytes);
    EXPECT_EQ(read_mesh(folder / "a.glb").space, "RAS");
    const Mesh moved = read_mesh(folder / "b.glb");
    EXPECT_EQ(moved.space, "unknown");
    EXPECT_LT(moved.points.at(0)[0], 0.1);
}

}  // namespace
