// What write_surface writes, read_mesh reads back: points, triangles with their direction, ids.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "formats/common/precision.h"
#include "formats/mesh/mesh_formats.h"
#include "unit/formats/mesh/mesh_samples.h"

using namespace isoatlas;
using namespace mesh_samples;

namespace {

bool has_object(const std::string& extension) { return extension != ".stl"; }
bool has_contour(const std::string& extension) { return extension == ".ply" || extension == ".vtp"; }

class RoundTrip : public testing::TestWithParam<const char*> {
protected:
    Mesh through_file(const Surface& surface) {
        path_ = folder_ / (std::string("mesh") + GetParam());
        warnings_ = write_surface(path_, surface);
        return read_mesh(path_);
    }
    Folder folder_;
    std::string path_;
    std::vector<std::string> warnings_;
};

/// Equal triangles; positions equal in float32 (a text says 0.1 where the binary formats say float32(0.1)).
void expect_same(const Mesh& mesh, const Surface& surface, const std::string& extension) {
    const isoatlas::Array<std::int64_t> none;
    const auto expected = sorted_triangles(in_float32(surface.points), surface.triangles, has_object(extension) ? surface.object : none,
                                           has_contour(extension) ? surface.contour : none);
    EXPECT_TRUE(sorted_triangles(in_float32(mesh.points), mesh.triangles, mesh.object, mesh.contour) == expected);
}

TEST_P(RoundTrip, keeps_triangles_and_ids) {
    const Surface surface = two_objects();
    const Mesh mesh = through_file(surface);
    EXPECT_EQ(mesh.points.size(), surface.points.size());
    if (std::string(GetParam()) == ".glb") {  // relative to the middle of the object: exact here but for 0.1
        ASSERT_EQ(mesh.triangles.size(), surface.triangles.size());
        const auto in_file = sorted_triangles(mesh.points, mesh.triangles, mesh.object, {});
        const auto expected = sorted_triangles(surface.points, surface.triangles, surface.object, {});
        for (std::size_t t = 0; t < expected.size(); ++t) {
            for (std::size_t k = 0; k < 3; ++k) {
                EXPECT_EQ(in_file[t][k].object, expected[t][k].object);
                for (std::size_t a = 0; a < 3; ++a) EXPECT_NEAR(in_file[t][k].point[a], expected[t][k].point[a], 1e-7);
            }
        }
    } else {
        expect_same(mesh, surface, GetParam());
    }
}

TEST_P(RoundTrip, keeps_far_away_points_apart) {
    const Surface surface = far_away();
    const Mesh mesh = through_file(surface);
    const std::string extension = GetParam();
    if (extension == ".stl") {
        ASSERT_EQ(warnings_.size(), 2U);
        EXPECT_NE(warnings_[1].find("merge 5 points"), std::string::npos) << warnings_[1];
        EXPECT_EQ(mesh.points.size(), 1U);
        return;
    }
    ASSERT_EQ(mesh.points.size(), 6U);
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t a = 0; a < 3; ++a) {
            if (extension == ".glb") {
                EXPECT_NEAR(mesh.points[i][a], surface.points[i][a], 1e-9);
            } else {
                EXPECT_EQ(mesh.points[i][a], surface.points[i][a]);
            }
        }
    }
}

TEST_P(RoundTrip, an_empty_surface_is_a_valid_file) {
    Surface surface;
    const Mesh mesh = through_file(surface);
    EXPECT_TRUE(mesh.points.empty());
    EXPECT_TRUE(mesh.triangles.empty());
}

TEST_P(RoundTrip, without_normals_and_ids) {
    Surface surface = two_objects();
    surface.normals.clear();
    surface.object.clear();
    surface.contour.clear();
    const Mesh mesh = through_file(surface);
    EXPECT_EQ(mesh.triangles.size(), surface.triangles.size());
    EXPECT_EQ(mesh.points.size(), surface.points.size());
    EXPECT_TRUE(mesh.object.empty());
    EXPECT_TRUE(mesh.contour.empty());
}

TEST_P(RoundTrip, hostile_unit_and_space_do_not_break_the_file) {
    Surface surface = two_objects();
    surface.unit = "mm\nelement vertex 99\n\"}]</DataArray>--\x01\xff";
    surface.space = "o object_1\r\nend_header\n";
    const Mesh mesh = through_file(surface);
    EXPECT_EQ(mesh.points.size(), surface.points.size());
    EXPECT_EQ(mesh.triangles.size(), surface.triangles.size());
}

TEST_P(RoundTrip, upper_case_extension_and_broken_surfaces) {
    std::string upper = GetParam();
    std::transform(upper.begin(), upper.end(), upper.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    EXPECT_NO_THROW(write_surface(folder_ / ("MESH" + upper), two_objects()));
    Surface bad_index = two_objects(), bad_ids = two_objects();
    bad_index.triangles[3][1] = 18;
    bad_ids.object.pop_back();
    const std::string path = folder_ / (std::string("bad") + GetParam());
    for (const Surface& surface : {bad_index, bad_ids}) {
        try {
            write_surface(path, surface);
            FAIL() << "accepted";
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::usage);
        }
        EXPECT_FALSE(std::filesystem::exists(path));
    }
}

INSTANTIATE_TEST_SUITE_P(Formats, RoundTrip, testing::Values(".ply", ".stl", ".obj", ".vtp", ".glb"),
                         [](const auto& format) { return std::string(format.param).substr(1); });

TEST(write_surface, curves_go_to_ply_obj_and_vtp_only) {
    const Folder folder;
    for (const char* extension : {".ply", ".obj", ".vtp"}) {
        const std::string path = folder / (std::string("curve") + extension);
        EXPECT_TRUE(write_surface(path, curve()).empty());
        const Mesh mesh = read_mesh(path);
        EXPECT_EQ(mesh.points, curve().points);
        EXPECT_TRUE(mesh.triangles.empty());
        EXPECT_EQ(mesh.object, curve().object) << extension;
    }
    for (const char* extension : {".stl", ".glb"}) {
        try {
            write_surface(folder / (std::string("curve") + extension), curve());
            FAIL() << extension;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::usage);
            EXPECT_EQ(error.text().next, "write .ply, .obj, .vtp or .vtkhdf");
        }
    }
    EXPECT_EQ(folder.files(), 3U);
}

TEST(write_surface, unknown_extensions_name_the_known_ones) {
    for (const char* name : {"mesh.fbx", "mesh", "mesh.ply.gz"}) {
        for (const bool writing : {true, false}) {
            try {
                writing ? (void)write_surface(name, Surface{}) : (void)read_mesh(name);
                FAIL() << name;
            } catch (const Error& error) {
                EXPECT_EQ(error.kind(), ErrorKind::usage);
                for (const char* known : {".ply", ".stl", ".obj", ".vtp", ".glb"}) {
                    EXPECT_NE(std::string(error.what()).find(known), std::string::npos);
                }
            }
        }
    }
}

TEST(write_surface, warns_about_what_a_format_loses) {
    const Folder folder;
    EXPECT_TRUE(write_surface(folder / "a.ply", two_objects()).empty());
    EXPECT_TRUE(write_surface(folder / "a.vtp", two_objects()).empty());
    EXPECT_EQ(write_surface(folder / "a.stl", two_objects()).size(), 1U);
    EXPECT_EQ(write_surface(folder / "a.obj", two_objects()).size(), 1U);
    EXPECT_EQ(write_surface(folder / "a.glb", two_objects()).size(), 1U);
}

TEST(precision, float32_unless_it_merges_flattens_or_is_too_coarse) {
    EXPECT_EQ(position_precision(two_objects()), Real::f32);
    EXPECT_EQ(position_precision(far_away()), Real::f64);
    EXPECT_EQ(position_precision(Surface{}), Real::f32);
    Surface merged;
    merged.points = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1 + 1e-9, 0, 0}, {0, 2, 0}, {0, 0, 2}};
    merged.triangles = {{0, 1, 2}, {3, 4, 5}};
    EXPECT_EQ(position_precision(merged), Real::f64);
    EXPECT_EQ(points_merged_by_float32(merged.points), 1);
    merged.points[3][0] = 1;  // equal already: float32 loses nothing
    EXPECT_EQ(position_precision(merged), Real::f32);
    Surface flat;
    flat.points = {{0, 0, 0}, {1, 0, 0}, {2, 1e-50, 0}};
    flat.triangles = {{0, 1, 2}};
    EXPECT_EQ(position_precision(flat), Real::f64);
    Surface coarse = two_objects();
    for (auto& p : coarse.points) p[0] += 1e5;
    EXPECT_EQ(position_precision(coarse), Real::f64);
}

/// Any numbers: what is written in float64 comes back bit for bit.
RC_GTEST_PROP(RoundTripOfAnything, ply_obj_and_vtp_are_lossless, ()) {
    static const Folder folder;
    Surface surface;
    const int count = *rc::gen::inRange(3, 12);
    for (int i = 0; i < count; ++i) {
        Point p{};
        for (double& x : p)
            x = static_cast<double>(*rc::gen::inRange<std::int64_t>(-(std::int64_t{1} << 52), std::int64_t{1} << 52)) * 0x1p-30 / 3;
        surface.points.push_back(p);
        surface.object.push_back(*rc::gen::inRange<std::int64_t>(0, std::int64_t{1} << *rc::gen::inRange(2, 50)));
    }
    surface.contour = surface.object;
    const int triangles = *rc::gen::inRange(0, 12);
    for (int t = 0; t < triangles; ++t) {
        const std::int64_t a = *rc::gen::inRange(0, count), b = *rc::gen::inRange(0, count), c = *rc::gen::inRange(0, count);
        surface.triangles.push_back({a, b, c});
    }
    for (const std::string extension : {".ply", ".vtp"}) {
        const std::string path = folder / ("any" + extension);
        write_surface(path, surface);
        const Mesh mesh = read_mesh(path);
        const bool wide = position_precision(surface) == Real::f64;
        RC_ASSERT(mesh.points == (wide ? surface.points : in_float32(surface.points)));
        RC_ASSERT(mesh.triangles == surface.triangles);
        RC_ASSERT(mesh.object == surface.object);
        RC_ASSERT(mesh.contour == surface.contour);
    }
    write_surface(folder / "any.obj", surface);
    const Mesh mesh = read_mesh(folder / "any.obj");
    RC_ASSERT(mesh.points.size() == surface.points.size());
    RC_ASSERT(mesh.triangles.size() == surface.triangles.size());
}

}  // namespace
