// Surfaces as extract makes them, through every file format: what was closed, manifold and without flat triangles still is.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "isoatlas/phantom.h"
#include "isoatlas/surface.h"
#include "unit/formats/mesh/mesh_samples.h"

using namespace isoatlas;
using namespace mesh_samples;

namespace {

std::vector<std::int64_t> sorted_chi(const SurfaceReport& report) {
    std::vector<std::int64_t> chi = report.component_chi;
    std::sort(chi.begin(), chi.end());
    return chi;
}

/// Empty: the file holds the same surface. Formats of float32 may merge points; they say so and are let off.
std::string difference(const Surface& surface, const std::string& path) {
    const std::vector<std::string> warnings = write_surface(path, surface);
    for (const std::string& warning : warnings) {
        if (warning.find("merge") != std::string::npos) return {};
    }
    const Mesh mesh = read_mesh(path);
    const SurfaceReport before = inspect(surface.points, surface.triangles), after = inspect(mesh.points, mesh.triangles);
    if (after.points != before.points || after.triangles != before.triangles || after.edges != before.edges) return "counts differ";
    if (!after.is_closed() || !after.is_manifold() || !after.is_oriented()) return "not a closed oriented manifold";
    if (!path.ends_with(".stl") && !path.ends_with(".glb") && after.zero_area_triangles > before.zero_area_triangles)
        return "flat triangles";
    return sorted_chi(after) == sorted_chi(before) ? "" : "Euler numbers differ";
}

RC_GTEST_PROP(ExtractedSurface, survives_every_format, ()) {
    static const Folder folder;
    Extent extent{3, {*rc::gen::inRange(1, 6), *rc::gen::inRange(1, 6), *rc::gen::inRange(1, 6)}};
    const int values = *rc::gen::element(2, 3, 5, 30000);
    std::vector<std::int16_t> samples(static_cast<std::size_t>(extent.voxels()));
    for (std::int16_t& s : samples) s = static_cast<std::int16_t>(*rc::gen::inRange(0, values));
    Geometry geometry;
    geometry.spacing = {0.7, 1.3, *rc::gen::element(0.01, 1.0, 100.0)};
    geometry.origin = {*rc::gen::element(0.0, -100.0, 1e6), 3, 0.1};
    const Volume volume = make_volume<std::int16_t>(extent, samples, geometry);
    const double tau = *rc::gen::inRange(0, values) + *rc::gen::element(0.0, 0.5, 1e-9);
    const Surface surface = extract(volume, tau);
    for (const char* extension : {".ply", ".stl", ".obj", ".vtp", ".glb"}) {
        const std::string path = folder / (std::string("surface") + extension);
        const std::string problem = difference(surface, path);
        if (!problem.empty()) RC_FAIL(std::string(extension) + ": " + problem);
    }
}

TEST(ExtractedSurface, noise_and_2d) {
    const Folder folder;
    const Volume noise = make_phantom("noise", {.size = 16});
    const Surface surface = extract(noise, 0.5);
    ASSERT_GT(surface.triangles.size(), 1000U);
    for (const char* extension : {".ply", ".stl", ".obj", ".vtp", ".glb"}) {
        EXPECT_EQ(difference(surface, folder / (std::string("noise") + extension)), "") << extension;
    }
    const Volume image = make_volume<std::uint8_t>(Extent{2, {3, 3, 1}}, std::vector<std::uint8_t>{0, 0, 0, 0, 9, 0, 0, 0, 0});
    const Surface curve = extract(image, 5);
    ASSERT_FALSE(curve.segments.empty());
    for (const char* extension : {".ply", ".obj", ".vtp"}) {
        const std::string path = folder / (std::string("curve") + extension);
        write_surface(path, curve);
        EXPECT_EQ(read_mesh(path).points.size(), curve.points.size()) << extension;
    }
}

}  // namespace
