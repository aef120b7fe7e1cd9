// What is printed: pieces worth printing, in millimetres.
#include "isoatlas/print.h"

#include <gtest/gtest.h>

#include "isoatlas/error.h"
#include "isoatlas/surface.h"

namespace isoatlas {
namespace {

/// Boxes of High samples in a row, of these numbers of samples along each axis.
Volume boxes(const std::vector<std::int64_t>& sides) {
    std::int64_t length = 1;
    for (const std::int64_t side : sides) length += side + 2;
    const std::int64_t width = *std::ranges::max_element(sides) + 2;
    Geometry geometry;
    geometry.spacing = {2, 2, 2}, geometry.unit = "cm";
    Volume volume = make_volume({3, {length, width, width}}, ValueType::u8, geometry);
    std::ranges::fill(volume.bytes, std::byte{0});
    std::int64_t begin = 1;
    for (const std::int64_t side : sides) {
        for (std::int64_t z = 0; z < side; ++z) {
            for (std::int64_t y = 0; y < side; ++y) {
                for (std::int64_t x = 0; x < side; ++x)
                    volume.bytes[static_cast<std::size_t>(volume.info.extent.index(begin + x, y + 1, z + 1))] = std::byte{2};
            }
        }
        begin += side + 2;
    }
    return volume;
}

TEST(Print, DropsSpecksAndIsInMillimetres) {
    const Volume volume = boxes({12, 1, 6, 1});
    const Surface whole = extract(volume, 1);
    Surface surface = whole;
    const PrintReport report = prepare_for_print(surface, {.millimetres = 10, .speck = 0.01});
    EXPECT_EQ(report.pieces, 2);
    EXPECT_EQ(report.specks, 2);
    EXPECT_EQ(surface.unit, "mm");
    const SurfaceReport shape = inspect(surface.points, surface.triangles);
    EXPECT_TRUE(shape.is_closed() && shape.is_manifold() && shape.is_oriented());
    EXPECT_EQ(shape.unused_points, 0);
    EXPECT_EQ(shape.component_chi.size(), 2U);
    EXPECT_EQ(surface.normals.size(), surface.points.size());
    EXPECT_EQ(surface.object.size(), surface.points.size());
    // A speck is an octahedron whose corners are half a step away, of 2 cm: 4/3 r^3.
    EXPECT_NEAR(report.largest_speck, 4.0 / 3 * 1000, 1e-6);
    EXPECT_NEAR(report.size_mm[1], 12 * 20, 1e-9);
    EXPECT_GT(report.volume, 11 * 11 * 11 * 8000);
    EXPECT_LT(report.volume, (12 * 12 * 12 + 6 * 6 * 6) * 8000);
    Surface all = whole;
    EXPECT_EQ(prepare_for_print(all, {.speck = 0}).pieces, 4);
    EXPECT_TRUE(all.points == whole.points && all.triangles == whole.triangles);
}

TEST(Print, RefusesWhatIsNoSolid) {
    Surface open = extract(boxes({3}), 1);
    open.closed = false;
    EXPECT_THROW(prepare_for_print(open), Error);
    Surface surface = extract(boxes({3}), 1);
    for (const PrintOptions options : {PrintOptions{.millimetres = 0}, PrintOptions{.speck = 2}, PrintOptions{.speck = -1}})
        EXPECT_THROW(prepare_for_print(surface, options), Error);
    Surface nothing;
    EXPECT_EQ(prepare_for_print(nothing).pieces, 0);
}

}  // namespace
}  // namespace isoatlas
