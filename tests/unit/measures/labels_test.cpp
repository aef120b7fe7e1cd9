// Measures of labels: counts are those of the table of labels, sizes those of the mask of the label, all of its pieces together.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "isoatlas/labels.h"
#include "isoatlas/measures.h"
#include "oracle/mesh_checks.h"

namespace oracle {
namespace {

using isoatlas::ObjectMeasures;
using isoatlas::Volume;

/// Where the samples are the label, in a volume of the same size.
Volume mask_of_all(const Volume& labels, std::int64_t label) {
    Volume mask = labels;
    for (std::uint8_t& sample : mask.samples<std::uint8_t>()) sample = sample == label ? 1 : 0;
    return mask;
}

void are_those_of_their_masks() {
    Grid grid = *arbitrary_grid(7, 100);
    for (double& value : grid.value) value = static_cast<double>(static_cast<std::int64_t>(std::abs(value)) % 4);
    Volume volume = to_volume(grid, isoatlas::ValueType::u8);
    volume.info.geometry = arbitrary_geometry(grid);
    const isoatlas::Interpolant interpolant = *arbitrary_interpolant();
    const isoatlas::LabelTable table = isoatlas::list_labels(volume, {.interpolant = interpolant});
    const std::vector<ObjectMeasures> objects = isoatlas::measure_labels(volume, {.interpolant = interpolant}, arbitrary_context());
    RC_ASSERT(objects.size() == table.regions.size());
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const ObjectMeasures& object = objects[i];
        const isoatlas::LabelRegion& region = table.regions[i];
        RC_ASSERT(object.id == region.label);
        RC_ASSERT(object.voxels == region.voxels);
        RC_ASSERT(object.tunnels == region.tunnels);
        RC_ASSERT(object.cavities == region.cavities);
        RC_ASSERT(object.euler == region.components - region.tunnels + region.cavities);
        RC_ASSERT(object.values.mean == static_cast<double>(region.label));
        double volume_of_pieces = 0, area = 0, voxel_volume = 0;
        bool touches = false;
        for (const ObjectMeasures& piece : measure_objects(mask_of_all(volume, region.label), 0.5, {.interpolant = interpolant})) {
            volume_of_pieces += piece.volume, area += piece.area, voxel_volume += piece.voxel_volume;
            touches = touches || piece.touches_border;
        }
        RC_ASSERT(std::abs(object.volume - volume_of_pieces) <= 1e-9 * volume_of_pieces);
        RC_ASSERT(std::abs(object.area - area) <= 1e-9 * area);
        RC_ASSERT(std::abs(object.voxel_volume - voxel_volume) <= 1e-9 * voxel_volume);
        RC_ASSERT(object.touches_border == touches);
    }
}
RC_GTEST_PROP(MeasuredLabels, AreThoseOfTheirMasks, ()) { are_those_of_their_masks(); }

TEST(MeasuredLabels, OfSeveralPiecesAreOneObject) {
    Volume volume = isoatlas::make_volume({3, {20, 8, 8}}, isoatlas::ValueType::u8);
    std::ranges::fill(volume.samples<std::uint8_t>(), std::uint8_t{0});
    for (const std::int64_t x : {2, 3, 12, 13}) {
        for (const std::int64_t y : {3, 4}) {
            for (const std::int64_t z : {3, 4})
                volume.samples<std::uint8_t>()[static_cast<std::size_t>(volume.info.extent.index(x, y, z))] = 9;
        }
    }
    const std::vector<ObjectMeasures> labels = isoatlas::measure_labels(volume, {.thickness = true});
    ASSERT_EQ(labels.size(), 1U);
    EXPECT_EQ(labels[0].id, 9);
    EXPECT_EQ(labels[0].euler, 2);
    EXPECT_EQ(labels[0].cavities, 0);
    EXPECT_NEAR(labels[0].centroid[0], 7.5, 1e-12);
    EXPECT_NEAR(labels[0].feret.max, 12.2, 0.3);
    EXPECT_NEAR(labels[0].thickness.median, 2, 0.5);
    EXPECT_TRUE(isoatlas::measure_labels(isoatlas::make_volume({3, {3, 3, 3}}, isoatlas::ValueType::u8)).empty());
}

}  // namespace
}  // namespace oracle
